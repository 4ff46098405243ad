"""Tables of a result, in a laboratory's units."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from math import isfinite
from typing import Any

import numpy as np
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from tribo.cli.console import Console, titled
from tribo.core.words import readable
from tribo.lab.inferred import InferredVolume
from tribo.lab.report import BodyReport, lab_report
from tribo.lab.running_in import groove_length, rough_bodies, worn_roughness
from tribo.result.layout import BETWEEN, EFFECT, STATE
from tribo.result.read import Result

COLUMNS = (
    ("time", "s", "time_s", 1, "g"),
    ("path", "m", "distance_m", 1, ".4g"),
    ("load", "N", "load_N", 1, ".4g"),
    ("p max", "MPa", "max_pressure_Pa", 1e-6, ".0f"),
    ("p centre", "MPa", "centre_pressure_Pa", 1e-6, ".0f"),
    ("along", "µm", "contact_half_width_x_m", 2e6, ".0f"),
    ("across", "µm", "contact_half_width_y_m", 2e6, ".0f"),
    ("area", "mm²", "contact_area_m2", 1e6, ".3f"),
)
"""Name, unit, key in a save, factor to the unit, and format of each column."""
VARYING = ("load",)
"""Columns shown only where they vary from save to save."""
DISPENSABLE = ("area", "p centre", "path", "along", "across")
"""Columns left out on a narrow terminal, in this order."""
ROUGHNESS = (
    ("Sa", "Sa_m", 1e9, ".3g"),
    ("Sq", "Sq_m", 1e9, ".3g"),
    ("Sz", "Sz_m", 1e9, ".3g"),
    ("Ssk", "Ssk", 1, ".2f"),
    ("Sku", "Sku", 1, ".2f"),
    ("Ra along", "Ra_along_m", 1e9, ".3g"),
    ("Ra across", "Ra_across_m", 1e9, ".3g"),
)
"""Name, key, factor to nm, and format of each column."""
WHERE = {"scar": "scar", "unworn": "at first", "beside": "beside"}
WIDE = 10_000
"""More characters than any table needs."""
NOTHING = "–"
LOW = 20.0
"""Largest pressure up to which those of a column have decimals, in MPa."""
SHALLOW = 1e-7
"""Depth below which the depths of a body are in nm."""


def print_report(result: Result, console: Console | None = None, *, told: str = "") -> None:
    """Print the saves, the worn bodies and the first contact of `result`.

    A notice of the kind `told` is left out.
    """
    console = console or Console()
    lab = lab_report(result)
    _print_saves(result, console)
    if shares := _shares_along(result):
        console.print(
            f"The load changes along the stroke, from {min(shares):g} to {max(shares):g} of the "
            "normal load; the table has its mean over the path, and pressures in the middle."
        )
    console.print(wear_table(result, lab.bodies))
    if rough := rough_bodies(result):
        console.print(roughness_table(result, rough))
    if lab.inferred:
        console.print(inferred_table(lab.inferred))
    if (fields := fields_table(result)) is not None:
        console.print(fields)
    console.print(lab.first_contact_words, markup=False)
    saves = result.saves()
    plastic = [save["plastic_area_m2"] / save["contact_area_m2"] for save in (saves[0], saves[-1])]
    if max(plastic) > 0:
        first, last = (f"{100 * part:.2g} %" for part in plastic)
        console.print(f"At the hardness: {first} of the contact at first, {last} at the end.")
    for words in friction_words(result):
        console.print(words)
    for row in lab.rows:
        console.print(str(row), markup=False)
    totals, worst = result.totals(), result.worst()
    took = "" if result.wall_time is None else f", {readable(result.wall_time, '.1f')} s"
    console.print(f"{totals['steps']} steps, {totals['contact_solves']} contact solves{took}.")
    console.print(
        f"At worst: load off by {worst['force_error']:.0e}, worn volume by "
        f"{worst['volume_error']:.0e}, gap under pressure {worst['complementarity_error']:.0e}, "
        f"overlap {worst['penetration_error']:.0e}, chattering {worst['chattering']:.0e}."
    )
    if result.status != "done":
        stopped = result.status in ("killed", "interrupted")
        remedy = f" To go on with it: tribo resume {escape(result.name)}" if stopped else ""
        console.print(f"[yellow]This run is {result.status}, not done.{remedy}[/]")
    for notice in result.notices:
        if notice.partition(":")[0] != told:
            console.print(f"[yellow]Note:[/] {escape(notice)}")


def friction_words(result: Result) -> list[str]:
    """Return a line with the friction force at the end and the work; none without friction."""
    last = result.saves()[-1]
    if "friction_energy_J" not in last:
        return []
    force, work = last["friction_force_N"], last["friction_energy_J"]
    return [f"Friction: {force:.4g} N at the end, {work:.4g} J dissipated."]


def print_provenance(result: Result, console: Console | None = None) -> None:
    """Print where each model of `result` came from, its configuration and what it states."""
    console = console or Console()
    made = result.provenance
    console.print()
    for again in (made, *made.get("resumed_with", ())):
        packages = ", ".join(f"{name} {version}" for name, version in again["packages"].items())
        console.print(
            f"{'Made' if again is made else 'Gone on'} with Python {again['python']}, {packages}; "
            "models, in SI units:",
            markup=False,
        )
        if begun := again.get("begun_with"):
            console.print(
                f"  begun with {begun['result']}, SHA-256 {begun['sha256']}", markup=False
            )
        for place, origin in again["components"].items():
            for line in _origin(place, origin):
                console.print(Text(line), soft_wrap=True)
        for plugin in again["plugins"]:
            if plugin["status"] not in ("loaded", "available"):
                console.print(
                    f"  plugin {plugin['distribution']} {plugin['version']} was "
                    f"{plugin['status']}: {plugin['reason']}",
                    markup=False,
                )


def _origin(place: str, origin: Mapping[str, Any]) -> Iterator[str]:
    whose = f"{origin['distribution']} {origin['version']}".strip()
    where = f"{origin['class']} of {whose}" if whose else origin["class"]
    editable = ", editable" if origin["editable"] else ""
    code = f", source code {origin['code'][:10]}" if origin["code"] else ", source not available"
    yield f"  {place}: {origin['type']}, {where}{editable}{code}"
    config = [
        f"{key} = {json.dumps(value, ensure_ascii=False)}"
        for key, value in origin["config"].items()
        if key != "type" and value is not None
    ]
    if config:
        yield f"      {', '.join(config)}"
    for name, text in origin["facts"].items():
        yield f"      {name}: {text}"


def _print_saves(result: Result, console: Console) -> None:
    """Print the table of saves, and what had to be left out of it to fit the width."""
    left_out: list[str] = []
    unbounded = console.options.update(width=WIDE)
    table = saves_table(result, left_out)
    for name in DISPENSABLE:
        if console.measure(table, options=unbounded).minimum <= console.width:
            break
        left_out.append(name)
        table = saves_table(result, left_out)
    console.print(table)
    if left_out:
        console.print(f"Left out for want of width: {', '.join(left_out)}.")


def saves_table(result: Result, left_out: Sequence[str] = ()) -> Table:
    """Return the contact and the largest depths at each save."""
    table = titled("Contact, full widths along and across sliding; wear depth of each body")
    saves, along = result.saves(), _shares_along(result)
    columns = []
    for name, unit, key, factor, digits in COLUMNS:
        values = [factor * save[key] for save in saves]
        # Of a flat contact whole MPa are too coarse.
        shown = ".2f" if unit == "MPa" and 0 < max(values) < LOW else digits
        cells = [readable(value, shown) for value in values]
        steady = name in VARYING and len(set(cells)) == 1 and not along
        if name not in left_out and not steady:
            table.add_column(f"{name}\n{unit}", justify="right", no_wrap=True)
            columns.append(cells)
    for body in result.body_names:
        worn = [save["bodies"][body]["max_wear_depth_m"] for save in saves]
        unit, factor = ("nm", 1e9) if 0 < max(worn) < SHALLOW else ("µm", 1e6)
        depths = [readable(factor * depth, ".2f") for depth in worn]
        # A long name is broken before a number is.
        table.add_column(
            f"{escape(body)}\n{unit}",
            justify="right",
            overflow="fold",
            min_width=max(map(len, depths)),
        )
        columns.append(depths)
    for row in zip(*columns, strict=True):
        table.add_row(*row)
    return table


def _shares_along(result: Result) -> list[float]:
    """Return the shares of a load that changes along the stroke; none if it does not."""
    load = result.case.get("load", {})
    return [place["share"] for place in load.get("along", ())] if isinstance(load, Mapping) else []


def wear_table(result: Result, bodies: Mapping[str, BodyReport]) -> Table:
    """Return what a lab would measure of each body at the end."""
    last = result.saves()[-1]
    tracks = [f"{n} (track)" if body.scar_along_m is None else n for n, body in bodies.items()]
    before = ", what it began with included" if result.case.get("begin") else ""
    table = titled(f"Wear after {last['distance_m']:.4g} m{before}", *tracks)
    lengths = {name: groove_length(result, name) for name in bodies}
    worn = [_worn(body, last["bodies"][name], lengths[name]) for name, body in bodies.items()]
    for row in worn[0]:
        cells = [body[row] for body in worn]
        if any(cell != NOTHING for cell in cells):
            table.add_row(row, *cells)
    return table


def _worn(body: BodyReport, save: Mapping[str, float], groove: float | None) -> dict[str, str]:
    """Return a body's cells by their row; `groove` is the length of one that is resolved, in m."""
    scarred = body.scar_across_m > 0
    rows: dict[str, tuple[float | None, float, str]] = {
        "volume, mm³": (save["wear_volume_m3"], 1e9, ".3g"),
        "mass, mg": (body.mass_kg, 1e6, ".3g"),
        "specific wear rate, mm³/(N·m)": (body.specific_wear_rate_mm3_per_Nm, 1, ".3g"),
        "scar along sliding, mm": ((body.scar_along_m or groove) if scarred else None, 1e3, ".3f"),
        "scar across, mm": (body.scar_across_m or None, 1e3, ".3f"),
        "section of the track, mm²": (body.track_section_m2 if scarred else None, 1e6, ".3g"),
        "largest depth, µm": (save["max_wear_depth_m"], 1e6, ".3g"),
        "largest plastic depth, µm": (save["max_plastic_depth_m"], 1e6, ".3g"),
    }
    cells = {
        row: NOTHING if value is None else readable(factor * value, digits)
        for row, (value, factor, digits) in rows.items()
    }
    if scarred and body.scar_along_m is None and groove is None:
        cells["scar along sliding, mm"] = "whole track"
    return cells


def roughness_table(result: Result, bodies: Sequence[str]) -> Table:
    """Set the roughness of rough bodies in their scars against what it was, and beside them."""
    table = titled("Roughness in nm, form removed", *(column[0] for column in ROUGHNESS))
    for body in bodies:
        measured = worn_roughness(result, result.body(body), -1)
        for where, values in measured._asdict().items():
            cells = [(factor * getattr(values, key), form) for _, key, factor, form in ROUGHNESS]
            shown = [f"{cell:z{form}}" if isfinite(cell) else NOTHING for cell, form in cells]
            if any(cell != NOTHING for cell in shown):
                table.add_row(f"{escape(body)}: {WHERE[where]}", *shown)
    return table


def inferred_table(volumes: Sequence[InferredVolume]) -> Table:
    """Set what a lab would infer from the scars against what was worn."""
    table = titled("Volume by a lab's formulas, and how far that is off", "mm³", "%")
    for each in volumes:
        table.add_row(
            f"{escape(each.body)}: {each.method}"
            + (f" ({each.standard})" if each.standard else ""),
            f"{1e9 * each.volume_m3:.3g}",
            each.off,
        )
    return table


def fields_table(result: Result) -> Table | None:
    """Return what effects and laws provide or keep at the last save; None if that is nothing."""
    if not any(map(result.fields_of, (BETWEEN, EFFECT, STATE))):
        return None
    # Slow to import, and needed for such results only.
    from tribo.plotting.kept import kept_fields
    from tribo.plotting.units import shown_in

    columns = "least", "mean in the contact", "largest"
    table = titled("Fields of effects and wear laws at the end", *columns)
    for field in kept_fields(result):
        last = field.values[-1]
        unit, factor = shown_in(field.unit, last)
        cells = (np.min(last), field.mean(result, -1), np.max(last))
        table.add_row(
            escape(f"{field.name}, {unit}" if unit else field.name),
            *(f"{cell / factor:.4g}" for cell in cells),
        )
    return table if table.rows else None
