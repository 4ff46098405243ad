"""The table of a comparison: a column a result, in a lab's units."""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Iterator, Sequence
from math import isnan, nan
from typing import TYPE_CHECKING

from tribo.core.column import labelled
from tribo.core.data_table import DataTable, Heading, TableRow
from tribo.core.words import readable, signed
from tribo.lab.report import quantity_rows
from tribo.lab.units import row_name
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
    ("largest pressure", "max_pressure_Pa", "Pa", 1, ".4g"),
    ("centre pressure", "centre_pressure_Pa", "Pa", 1, ".4g"),
    ("width along ± a cell", "contact_half_width_x_m", "m", 2, ".3g"),
    ("width across ± a cell", "contact_half_width_y_m", "m", 2, ".3g"),
)
"""Name, key in a save, SI unit, multiple and format of each row."""
_OF_BODIES = (
    ("depth", "max_wear_depth_m", "m", 1, ".4g"),
    ("volume", "wear_volume_m3", "m^3", 1, ".3g"),
)


def comparison_table(comparison: Comparison, times: Sequence[float]) -> DataTable:
    """Return a column for each result, with what differs at `times`."""
    totals = [result.totals() for result in comparison.results.values()]
    rows = [TableRow((name, *(t[key] for t in totals)), form) for name, key, form in _TOTALS]
    found = [{row.key: row for row in quantity_rows(each)} for each in comparison.results.values()]
    for key, row in dict(ChainMap(*found)).items():
        values = [of[key].value if key in of else nan for of in found]
        name, size = row_name(row.label, row.unit, values)
        rows.append(TableRow((name, *(value / size for value in values)), ".4g"))
    for time in times:
        rows += [TableRow((f"at {time:g} s",)), *_at(comparison, time)]
    headings = Heading("", whole=True), *map(Heading, comparison.results)
    return DataTable("", headings, rows)


def _at(comparison: Comparison, time: float) -> Iterator[TableRow]:
    """Yield the rows at a time."""
    labels = list(comparison.results)
    saves = [comparison.save(label, time) for label in labels]
    first = comparison.results[comparison.reference]
    fields = [field for kind in SAVED for field in first.fields_of(kind).values()]
    own = [(f.name.replace("_", " "), labelled(f.name, f.unit), f.unit, 1, ".4g") for f in fields]
    for whose in ("", *comparison.bodies):
        tables = [save["bodies"][whose] for save in saves] if whose else saves
        for name, key, unit, multiple, form in (*(_OF_BODIES if whose else _SCALARS), *own):
            values = [multiple * float(table.get(key, nan)) for table in tables]
            if any(values) and not isnan(sum(values)):
                row, size = row_name(f"{whose} {name}".lstrip(), unit, values)
                cells = (
                    readable(value / size, form) + (_off(value, values[0]) if i else "")
                    for i, value in enumerate(values)
                )
                yield TableRow((row, *cells))
    off: dict[str, list[str | None]] = {}
    for i, label in enumerate(labels[1:], start=1):
        for name, each in differences(comparison.results[label], first, time).items():
            name = name.removeprefix("bodies.").replace(".wear_depth", " depth")
            cell = f"{_percent(each.l2)} %, {_percent(each.largest)} %"
            off.setdefault(f"{name} map", [None] * len(labels))[i] = cell
    yield from (TableRow((name, *shown)) for name, shown in off.items())


def _off(value: float, reference: float) -> str:
    """Return the difference of a value from the reference's."""
    return f" {signed(100 * (value / reference - 1), 1)} %" if reference else ""


def _percent(part: float) -> str:
    return f"{100 * part:.2g}" if part < 0.1 else f"{100 * part:.0f}"
