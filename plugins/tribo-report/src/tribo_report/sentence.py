"""The answer of a result in a sentence, with its uncertainty where that is known."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from tribo import CaseError, LabReport, Result
from tribo.kernel_api import doubt_of_depth, plus_minus, size

from tribo_report.amounts import amount
from tribo_report.printed import printed_by

AGREES = 0.02
"""Relative difference up to which a value agrees with a study of the same case."""

EXACT = 1e-6
"""Relative uncertainty up to which none is quoted: Archard's law fixes the volume."""
RAISED = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")

Estimate = Mapping[str, Any]
"""A row of ``tribo verify CASE --json``: name, unit, value and uncertainty."""


def read_verified(path: Path, result: Result) -> Sequence[Estimate]:
    """Return the estimates that ``tribo verify CASE --json`` printed of the case of `result`."""
    with printed_by("tribo verify CASE --json", path, "--verified"):
        estimates = json.loads(path.read_text(encoding="utf-8"))["estimates"]
        read = [
            {key: row[key] for key in ("name", "unit", "value", "uncertainty")} for row in estimates
        ]
    for name, body in result.saves()[-1]["bodies"].items():
        volume, found = body["wear_volume_m3"], _of(read, f"{name}: volume")
        if found is None and volume == 0:
            continue
        if found is None or not math.isclose(volume, found["value"], rel_tol=AGREES):
            other = "has none" if found is None else f"gives {found['value']:.4g} m³"
            raise CaseError(
                f"{path} is of another case: {name} of {result.name} lost {volume:.4g} m³, the "
                f"study {other}",
                "--verified",
            )
    return read


def sentence(result: Result, lab: LabReport, verified: Sequence[Estimate]) -> str:
    """Return the volume and depth that each body has lost, with distance and load."""
    last = result.saves()[-1]
    losses = []
    for name, report in lab.bodies.items():
        volume, depth = (
            last["bodies"][name][key] for key in ("wear_volume_m3", "max_wear_depth_m")
        )
        if volume == 0:
            losses.append(f"the {name} lost nothing")
            continue
        words = f"the {name} lost {quoted(volume, 'mm³', _of(verified, f'{name}: volume'))}"
        if report.mass_kg is not None:
            words += f" ({quoted(report.mass_kg, 'mg')})"
        deepest = quoted(depth, "µm", _of(verified, f"{name}: largest depth"))
        losses.append(f"{words} and is worn {deepest} deep{doubt_of_depth(result)}")
    under = f"Over {last['distance_m']:.4g} m of sliding under {load_words(result)}"
    text = f"{under} {', '.join(losses)}."
    for name, body in result.case_tables["bodies"].items():
        text += _coating(result, name, len(body.get("layers") or ()))
    if result.status != "done":
        text += f" The run is {result.status}; this is its save at {last['time_s']:.4g} s."
    return text


def _coating(result: Result, name: str, layers: int) -> str:
    """Name the layers of a body that were worn through, and when."""
    if not layers:
        return ""
    place = f"bodies.{name}.layers."
    passed = [each for each in result.findings if each.place.startswith(place)]
    what = "coating" if layers == 1 else f"coating ({layers} layers)"
    if not passed:
        return f" The {what} of the {name} is nowhere worn through."
    last = passed[-1]
    which = "" if layers == 1 else f" down to layer {last.place.removeprefix(place)}"
    return (
        f" The {what} of the {name} is worn through{which} at its deepest point since "
        f"{last.distance:.4g} m."
    )


def quoted(value: float, unit: str, study: Estimate | None = None) -> str:
    """Return a value in a unit with three digits, or with as many as its uncertainty leaves it."""
    scale, power = size(unit), 0
    # Three digits, with a power of ten where zeros would hide them.
    if value and not 1e-4 <= value / scale < 1e5:
        power = math.floor(math.log10(value / scale))
    number = value / scale / 10.0**power
    words = f"{number:.3g}" if number < 1e3 else f"{float(f'{number:.3g}'):,.0f}"
    uncertain = None if study is None else study["uncertainty"]
    if uncertain and uncertain > EXACT * value:
        off = uncertain / scale / 10.0**power
        words = " ± ".join(plus_minus(number, off))
        words = f"({words})" if power else words
    return f"{words} × 10{str(power).translate(RAISED)} {unit}" if power else f"{words} {unit}"


def trust(verified: Sequence[Estimate]) -> str:
    """Return the meaning of the numbers after ±, or the command to get them."""
    if verified:
        return (
            "± is the numerical uncertainty, of grid and time steps together, found on three grids "
            "and with three lengths of step. It says nothing of the wear coefficient, nor of what "
            "the model leaves out."
        )
    return (
        "The numerical uncertainty of these values was not estimated. For it: tribo verify CASE "
        "--json > study.json, then tribo report RESULT --verified study.json."
    )


def load_words(result: Result) -> str:
    """Return the load, or its range."""
    loads = [save["load_N"] for save in result.saves()]
    ends = [amount(load, "N") for load in (min(loads), max(loads))]
    return " to ".join(dict.fromkeys(ends))


def _of(estimates: Sequence[Estimate], name: str) -> Estimate | None:
    return next((row for row in estimates if row["name"] == name), None)
