"""The table of a comparison: a column a result, in a lab's units."""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Iterator, Mapping, Sequence
from math import isnan, nan
from typing import TYPE_CHECKING, Any

import numpy as np

from tribo.core.column import labelled
from tribo.core.data_table import DataTable, Heading, TableRow
from tribo.core.fields import Field
from tribo.core.words import readable, signed
from tribo.lab.report import quantity_rows
from tribo.lab.units import shown_in
from tribo.result.layout import SAVED
from tribo.study.differences import differences

if TYPE_CHECKING:
    from tribo.study.comparison import Comparison

_TOTALS = (
    ("steps", "steps", ".0f"),
    ("contact solves", "contact_solves", ".0f"),
    ("time to solution, s", "wall_time_s", ".1f"),
)
_SCALARS = (
    ("largest pressure, MPa", "max_pressure_Pa", 1e-6, ".4g"),
    ("centre pressure, MPa", "centre_pressure_Pa", 1e-6, ".4g"),
    ("width along, µm", "contact_half_width_x_m", 2e6, ".0f"),
    ("width across, µm", "contact_half_width_y_m", 2e6, ".0f"),
)
_OF_BODIES = (
    ("depth, µm", "max_wear_depth_m", 1e6, ".4g"),
    ("volume, mm³", "wear_volume_m3", 1e9, ".3g"),
)

Scalars = dict[str, dict[str, Any]]
"""Of one moment, by the label of the result."""


def comparison_table(comparison: Comparison, times: Sequence[float]) -> DataTable:
    """Return a column for each result, with what differs at `times`."""
    totals = [result.totals() for result in comparison.results.values()]
    rows = [TableRow((name, *(t[key] for t in totals)), form) for name, key, form in _TOTALS]
    found = [{row.key: row for row in quantity_rows(each)} for each in comparison.results.values()]
    for key, row in dict(ChainMap(*found)).items():
        values = [of[key].value if key in of else nan for of in found]
        unit, size = shown_in(row.unit, np.array(values))
        name = f"{row.label}, {unit}".removesuffix(", ")
        rows.append(TableRow((name, *(value / size for value in values)), ".4g"))
    for time in times:
        rows += [TableRow((f"at {time:g} s",)), *_at(comparison, time)]
    headings = Heading("", whole=True), *map(Heading, comparison.results)
    return DataTable("", headings, rows)


def _at(comparison: Comparison, time: float) -> Iterator[TableRow]:
    """Yield the rows at a time."""
    labels, reference = list(comparison.results), comparison.reference
    saves = {label: comparison.save(label, time) for label in labels}
    first = comparison.results[reference]
    own = [field for kind in SAVED for field in first.fields_of(kind).values()]
    rows = {name: (saves, key, factor, digits) for name, key, factor, digits in _SCALARS}
    for body in comparison.bodies:
        worn = {label: save["bodies"][body] for label, save in saves.items()}
        for name, key, factor, digits in _OF_BODIES:
            rows[f"{body} {name}"] = worn, key, factor, digits
        rows |= {f"{body} {name}": row for name, row in _own(own, worn)}
    rows |= dict(_own(own, saves))
    for row, (tables, key, factor, digits) in rows.items():
        values = {label: float(table.get(key, nan)) for label, table in tables.items()}
        if any(values.values()) and not isnan(sum(values.values())):
            errors = {label: comparison.cell_error(label).get(key, 0.0) for label in labels}
            cells = (
                readable(factor * values[label], digits)
                + (f" ± {readable(factor * errors[label], '.2g')}" if errors[label] else "")
                + (_off(values, errors, label, reference) if label != reference else "")
                for label in labels
            )
            yield TableRow((row, *cells))
    off: dict[str, list[str | None]] = {}
    for i, label in enumerate(labels[1:], start=1):
        result = comparison.results[label]
        of = "map" if result.grid == first.grid else "sections"
        for name, each in differences(result, first, time).items():
            name = name.removeprefix("bodies.").replace(".wear_depth", " depth")
            cell = f"{_percent(each.l2)} %, {_percent(each.largest)} %"
            off.setdefault(f"{name} {of}", [None] * len(labels))[i] = cell
    yield from (TableRow((name, *shown)) for name, shown in off.items())


def _own(
    fields: Sequence[Field], tables: Scalars
) -> Iterator[tuple[str, tuple[Scalars, str, float, str]]]:
    """Yield a row for each column of a model, in the unit that fits its values."""
    for field in fields:
        key = labelled(field.name, field.unit)
        unit, size = shown_in(field.unit, np.array([t.get(key, nan) for t in tables.values()]))
        name = field.name.replace("_", " ")
        yield f"{name}, {unit}".removesuffix(", "), (tables, key, 1.0 / size, ".4g")


def _off(
    values: Mapping[str, float], errors: Mapping[str, float], label: str, reference: str
) -> str:
    """Return the difference of a value from the reference's, ± the sum of both errors."""
    if values[reference] == 0:
        return ""
    ratio = values[label] / values[reference]
    off = signed(100 * (ratio - 1), 1)
    error = 100 * (errors[label] + ratio * errors[reference]) / values[reference]
    if not error:
        return f" {off} %"
    # Of widths that count as many cells nothing more is known.
    return f"\n{off} ± {error:.2g} %" if ratio != 1 else "\nwithin a cell"


def _percent(part: float) -> str:
    return f"{100 * part:.2g}" if part < 0.1 else f"{100 * part:.0f}"
