"""The report of a calibration."""

from __future__ import annotations

import json
import math
import tomllib
from collections.abc import Iterator
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from tribo import CaseError, Finding
from tribo.kernel_api import (
    case_tables,
    digits_of,
    to_toml,
    validate_case,
)
from tribo_inverse.calibration.calibrate import DATA, Calibration
from tribo_inverse.calibration.quantities import in_si, p_words
from tribo_inverse.findings import UNLIKELY, bound
from tribo_inverse.fitted import fit_picture
from tribo_inverse.tables import fit_tables

from tribo_report.page import render, stills
from tribo_report.printed import printed_by
from tribo_report.result import facts, made_here


def calibration_file_page(path: Path) -> str:
    """Return the report of a file that ``tribo calibrate --json`` printed."""
    with printed_by("tribo calibrate --json", path):
        found = json.loads(path.read_text(encoding="utf-8"))
        read = _read(found)
    return calibration_page(read, path.stem)


def _read(found: dict[str, Any]) -> Calibration:
    tables: dict[str, Any] = {
        name: pd.DataFrame(found.pop(name)) for name in ("parameters", "data", "predictions")
    }
    for name in ("parameters", "predictions"):
        if "upper" in tables[name]:
            # JSON has no infinity.
            tables[name]["upper"] = tables[name]["upper"].fillna(math.inf)
    missing = {*DATA} - {*tables["data"]}
    if missing:
        raise ValueError(f"it has no {', '.join(sorted(missing))}")
    for name in ("p_value", "notes"):
        del found[name]
    for name in ("correlation", "singular_values"):
        found[name] = np.array(found[name], dtype=float)
    found["fitted"] = tomllib.loads(found.get("fitted", ""))
    found["findings"] = tuple(Finding(**each) for each in found["findings"])
    return Calibration(**tables, **found)


def calibration_page(found: Calibration, title: str) -> str:
    """Return the report of a calibration as HTML; see `tribo_report.write_report`."""
    return render(
        "study.html.j2",
        kind="Calibration",
        title=title,
        answers=list(_answers(found)),
        tables_title="What was fitted",
        tables=fit_tables(found),
        remarks=[],
        notes=found.notes,
        stills=stills({"fit, relative to the measured values": partial(fit_picture, found.data)}),
        **made_here(),
        case=to_toml(found.fitted),
        whose=" as fitted",
        facts=_facts(found),
    )


def _answers(found: Calibration) -> Iterator[str]:
    """Yield a warning of a misfit, then each estimate and its interval in a sentence."""
    if found.p_value is not None and found.p_value < UNLIKELY:
        yield (
            f"Data and model disagree, {p_words(found.p_value)}: the values below are not to be "
            "trusted before the reason is known; see the notes."
        )
    for each in found.parameters.itertuples():
        words = f"{each.path} is {in_si(each.value, each.unit)}"
        if each.held:
            yield f"{words}, held by its {bound(each)} bound."
        elif math.isinf(each.upper):
            yield f"{words}; the data do not bound it."
        else:
            digits = digits_of(each.lower, each.upper)
            yield (
                f"{each.path} is {in_si(each.value, each.unit, digits)}, between "
                f"{each.lower:.{digits}g} and {each.upper:.{digits}g} with a probability of "
                f"{100 * found.level:g} %."
            )


def _facts(found: Calibration) -> list[tuple[str, str]]:
    """Return the facts of the fitted case; none if plugins or files are missing."""
    with suppress(CaseError):
        return facts(case_tables(validate_case(found.fitted)))
    return []
