"""Tables of a result, in a laboratory's units."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from tribo.core.data_table import DataTable, Heading, TableRow
from tribo.core.words import readable
from tribo.lab.inferred import InferredVolume
from tribo.lab.report import MEASURES, BodyReport
from tribo.result.read import Result

COLUMNS = (
    (Heading("time", "s", "g", whole=True), "time_s", 1),
    (Heading("path", "m", ".4g", whole=True), "distance_m", 1),
    (Heading("load", "N", ".4g", whole=True), "load_N", 1),
    (Heading("p max", "MPa", ".4g", whole=True), "max_pressure_Pa", 1e-6),
    (Heading("p centre", "MPa", ".4g", whole=True), "centre_pressure_Pa", 1e-6),
    (Heading("along", "µm", ".0f", True, "width along"), "contact_half_width_x_m", 2e6),
    (Heading("across", "µm", ".0f", True, "width across"), "contact_half_width_y_m", 2e6),
    (Heading("area", "mm²", ".3f", whole=True), "contact_area_m2", 1e6),
)
"""Heading, key in a save, and factor to the unit of each column."""


def saves_table(result: Result) -> DataTable:
    """Return the contact and the largest depths at each save."""
    saves = result.saves()
    headings, columns = [], []
    for heading, key, factor in COLUMNS:
        values = [factor * save[key] for save in saves]
        # A load has a column only where it changes.
        if heading.label != "load" or len({readable(v, heading.form) for v in values}) > 1:
            headings.append(heading)
            columns.append(values)
    for body in result.body_names:
        headings.append(Heading(body, "µm", ".4g", name=f"{body} depth"))
        columns.append([1e6 * save["bodies"][body]["max_wear_depth_m"] for save in saves])
    title = "Contact, full widths along and across sliding; wear depth of each body"
    rows = list(map(TableRow, zip(*columns, strict=True)))
    return DataTable(title, headings, rows)


def wear_table(result: Result, bodies: Mapping[str, BodyReport]) -> DataTable:
    """Return a lab's measurements of each body at the end."""
    last = result.saves()[-1]
    tracks = [f"{n} (track)" if body.scar_along_m is None else n for n, body in bodies.items()]
    before = ", what it began with included" if result.case_tables.get("begin") else ""
    saves = [last["bodies"][name] for name in bodies]
    row = TableRow.scaled
    rows = [
        row("volume, mm³", (save["wear_volume_m3"] for save in saves), 1e9, ".3g"),
        *(
            row(f"{name}, {unit}", (getattr(b, key) or None for b in bodies.values()), factor, form)
            for name, unit, key, factor, form in MEASURES
        ),
        row(
            f"largest depth, µm{doubt_of_depth(result)}",
            (save["max_wear_depth_m"] for save in saves),
            1e6,
            ".3g",
        ),
        row("largest plastic depth, µm", (s["max_plastic_depth_m"] for s in saves), 1e6, ".3g"),
    ]
    title = f"Wear after {last['distance_m']:.4g} m{before}"
    return DataTable(title, list(map(Heading, ("", *tracks))), rows)


def doubt_of_depth(result: Result) -> str:
    """Return what to say beside a largest depth that a finding calls wrong; empty if none does."""
    wrong = any(each.kind == "averaging" for each in result.findings)
    return " (off: see averaging)" if wrong else ""


def inferred_table(volumes: Sequence[InferredVolume]) -> DataTable:
    """Compare the volumes that a lab would infer from the scars with the volumes worn."""
    rows = [
        TableRow((f"{each.body}: {each.method} ({each.standard})", 1e9 * each.volume_m3, each.off))
        for each in volumes
    ]
    headings = Heading(""), Heading("mm³", form=".3g"), Heading("%")
    title = "Volume by a lab's formulas, and how far that is off"
    return DataTable(title, headings, rows)
