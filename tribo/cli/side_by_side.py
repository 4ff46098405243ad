"""The table of a comparison: a column a result, in a lab's units."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from rich import box
from rich.markup import escape
from rich.table import Table

from tribo.cli.console import Console
from tribo.core.words import readable, signed
from tribo.study.comparison import Comparison
from tribo.study.differences import differences

_NAME_WIDTH = 26
_CELL_WIDTH = 16
_GAP = 3
NOTHING = "–"
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


def print_comparison(
    comparison: Comparison, times: Sequence[float], console: Console | None = None
) -> None:
    """Print what differs at `times`, as many results side by side as the width allows."""
    console = console or Console()
    labels = list(comparison.results)
    paths = list(dict.fromkeys(path for s in comparison.settings.values() for path in s))
    if paths:
        console.print(f"Varied: {', '.join(paths)}")
    console.print(
        f"Percentages are relative to {escape(comparison.reference)}. Maps are compared cell by "
        "cell, sections where grids differ: the L2 norm of the difference, then the largest, "
        "which of a pressure is often that of a cell at the rim."
    )
    # A label is broken between its words, unless two of them would not fit.
    longest = max((len(word) for label in labels for word in label.split()), default=0)
    room = max(console.width - _NAME_WIDTH, 2 * _CELL_WIDTH)
    cell = min(max(_CELL_WIDTH, longest + _GAP), room // 2)
    columns = max(2, room // cell)
    for start in range(0, len(labels), columns):
        shown = labels[start : start + columns]
        console.print(comparison_table(comparison, shown, times, cell))
    for note in comparison.notes:
        console.print(f"[yellow]Note:[/] {escape(note)}")


def how_compared(comparison: Comparison) -> str:
    """Say what the percentages of the table are."""
    return (
        f"Percentages are relative to {comparison.reference}; those of fields and sections "
        "are the L2 norm and the largest difference, of a pressure often that of a cell at the rim."
    )


def comparison_table(
    comparison: Comparison,
    labels: Sequence[str],
    times: Sequence[float],
    cell: int = _CELL_WIDTH,
) -> Table:
    """Return a column for each of some results, with what differs at `times`."""
    table = Table(box=box.SIMPLE_HEAD)
    table.add_column("", no_wrap=True)
    for label in labels:
        width = min(max(map(len, label.split()), default=0), cell - _GAP)
        table.add_column(escape(label), justify="right", overflow="fold", min_width=width)
    totals = [comparison.results[label].totals() for label in labels]
    for name, key, digits in _TOTALS:
        table.add_row(
            name, *(NOTHING if t[key] is None else readable(t[key], digits) for t in totals)
        )
    for time in times:
        table.add_section()
        table.add_row(f"[bold]at {time:g} s[/]")
        for name, cells in _at(comparison, labels, time).items():
            table.add_row(name, *cells)
    return table


def _at(comparison: Comparison, labels: Sequence[str], time: float) -> dict[str, list[str]]:
    """Return the cells of each row at a time, by the row's name."""
    reference = comparison.reference
    # The reference first, which may stand in another table.
    saves = {label: comparison.save(label, time) for label in (reference, *labels)}
    rows = {name: (saves, key, factor, digits) for name, key, factor, digits in _SCALARS}
    for body in comparison.bodies:
        worn = {label: save["bodies"][body] for label, save in saves.items()}
        for name, key, factor, digits in _OF_BODIES:
            rows[f"{body} {name}"] = worn, key, factor, digits
    found = {}
    for name, (tables, key, factor, digits) in rows.items():
        values = {label: float(table[key]) for label, table in tables.items()}
        if any(values.values()):
            errors = {label: comparison.cell_error(label).get(key, 0.0) for label in values}
            shown = {
                label: readable(factor * values[label], digits)
                + (f" ± {readable(factor * errors[label], '.2g')}" if errors[label] else "")
                + (_off(values, errors, label, reference) if label != reference else "")
                for label in labels
            }
            found[name] = list(shown.values())
    first = comparison.results[reference]
    for i, label in enumerate(labels):
        result = comparison.results[label]
        of = "map" if result.grid == first.grid else "sections"
        for name, each in differences(result, first, time).items() if label != reference else ():
            name = name.removeprefix("bodies.").replace(".wear_depth", " depth")
            cells = found.setdefault(f"{name} {of}", [NOTHING] * len(labels))
            cells[i] = f"{_percent(each.l2)} %, {_percent(each.largest)} %"
    return found


def _off(
    values: Mapping[str, float], errors: Mapping[str, float], label: str, reference: str
) -> str:
    """Return how far a value is off the reference's, ± what the errors of both add up to."""
    if values[reference] == 0:
        return ""
    ratio = values[label] / values[reference]
    off = signed(100 * (ratio - 1), 1)
    error = 100 * (errors[label] + ratio * errors[reference]) / values[reference]
    return f"\n{off} ± {error:.2g} %" if error else f" {off} %"


def _percent(part: float) -> str:
    return f"{100 * part:.2g}" if part < 0.1 else f"{100 * part:.0f}"
