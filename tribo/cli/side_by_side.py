"""The table of a comparison: a column a result, in a lab's units."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from rich import box
from rich.markup import escape
from rich.table import Table

from tribo.cli.console import Console
from tribo.study.comparison import Comparison
from tribo.study.differences import differences

_NAME_WIDTH = 26
_CELL_WIDTH = 16
_GAP = 3
NOTHING = "–"

Row = tuple[str, tuple[str, ...], float, str]
"""Name, keys of the value in a save, factor to its unit, digits."""


def print_comparison(
    comparison: Comparison, times: Sequence[float], console: Console | None = None
) -> None:
    """Print what differs at `times`, as many results side by side as the width allows."""
    console = console or Console(highlight=False)
    labels = list(comparison.results)
    paths = list(dict.fromkeys(path for s in comparison.settings.values() for path in s))
    if paths:
        console.print(f"Varied: {', '.join(paths)}")
    console.print(
        f"Percentages are relative to {escape(comparison.reference)}; those of fields are the L2 "
        "norm and the largest difference, which of a pressure is often that of a cell at the rim."
    )
    # A label is broken between its words, unless two of them would not fit.
    longest = max((len(word) for label in labels for word in label.split()), default=0)
    room = max(console.width - _NAME_WIDTH, 2 * _CELL_WIDTH)
    cell = min(max(_CELL_WIDTH, longest + _GAP), room // 2)
    columns = max(2, room // cell)
    for start in range(0, len(labels), columns):
        console.print(_table(comparison, labels[start : start + columns], times, cell))
    for note in comparison.notes:
        console.print(f"[yellow]Note:[/] {escape(note)}")


def _table(
    comparison: Comparison, labels: Sequence[str], times: Sequence[float], cell: int
) -> Table:
    table = Table(box=box.SIMPLE_HEAD)
    table.add_column("", no_wrap=True)
    for label in labels:
        table.add_column(
            escape(label),
            justify="right",
            overflow="fold",
            min_width=min(max(map(len, label.split()), default=0), cell - _GAP),
        )
    for name, key, digits in (
        ("steps", "steps", "{:.0f}"),
        ("contact solves", "contact_solves", "{:.0f}"),
        ("time to solution, s", "wall_time_s", "{:.1f}"),
    ):
        totals = (comparison.results[label].totals()[key] for label in labels)
        table.add_row(name, *(NOTHING if n is None else digits.format(n) for n in totals))
    for time in times:
        table.add_section()
        table.add_row(f"[bold]at {time:g} s[/]")
        expected = comparison.save(comparison.reference, time)
        saves = {label: comparison.save(label, time) for label in labels}
        for name, keys, factor, digits in _rows(comparison.bodies):
            if not any(_value(save, keys) for save in (expected, *saves.values())):
                continue
            cells = []
            for label, save in saves.items():
                value = _value(save, keys)
                off = "" if label == comparison.reference else _off(value, _value(expected, keys))
                cells.append(f"{factor * value:{digits}}{off}")
            table.add_row(name, *cells)
        for name, cells in _fields(comparison, labels, time):
            table.add_row(name, *cells)
    return table


def _rows(bodies: Sequence[str]) -> Iterator[Row]:
    yield "largest pressure, MPa", ("max_pressure_Pa",), 1e-6, ".4g"
    yield "centre pressure, MPa", ("centre_pressure_Pa",), 1e-6, ".4g"
    yield "half-width along, µm", ("contact_half_width_x_m",), 1e6, ".0f"
    yield "half-width across, µm", ("contact_half_width_y_m",), 1e6, ".0f"
    for body in bodies:
        yield f"{body} depth, µm", ("bodies", body, "max_wear_depth_m"), 1e6, ".4g"
        yield f"{body} volume, mm³", ("bodies", body, "wear_volume_m3"), 1e9, ".3g"


def _value(save: Any, keys: Sequence[str]) -> float:
    for key in keys:
        save = save[key]
    return float(save)


def _off(value: float, expected: float) -> str:
    if expected == 0:
        return ""
    # Adding zero takes the sign off what rounds to it.
    return f" {round(100 * (value / expected - 1), 1) + 0.0:+.1f} %"


def _fields(
    comparison: Comparison, labels: Sequence[str], time: float
) -> Iterator[tuple[str, list[str]]]:
    first = comparison.results[comparison.reference]
    found = {
        label: {d.field: d for d in differences(comparison.results[label], first, time)}
        for label in labels
        if label != comparison.reference
    }
    for field in dict.fromkeys(name for fields in found.values() for name in fields):
        name = field.removeprefix("bodies.").replace(".wear_depth", " wear")
        yield (
            f"{name} field",
            [
                f"{_percent(off.l2)}, {_percent(off.largest)} %" if off else NOTHING
                for off in (found.get(label, {}).get(field) for label in labels)
            ],
        )


def _percent(part: float) -> str:
    return f"{100 * part:.2g}" if part < 0.1 else f"{100 * part:.0f}"
