"""The tables a run ends with, in a lab's units."""

from __future__ import annotations

from typing import Any

from rich import box
from rich.console import Console
from rich.table import Table

from tribo.analysis.first_contact import hertz_contact
from tribo.analysis.lab import (
    in_mm3_per_newton_metre,
    mass_from_volume,
    scar,
    specific_wear_rate,
)
from tribo.results.read import Result


def print_report(result: Result, console: Console | None = None) -> None:
    """Print the saves, the worn bodies and the first contact of `result`."""
    console = console or Console(highlight=False)
    console.print(_saves(result))
    console.print(_bodies(result))
    console.print(_first_contact(result))
    totals = result.totals()
    worst = max(float(max(result.table("history")["force_error"])), 0.0)
    console.print(
        f"{totals['steps']} steps, {totals['contact_solves']} contact solves, "
        f"{totals['wall_time_s']:.1f} s; load balance within {worst:.0e}."
    )
    if result.status != "done":
        console.print(f"[yellow]This run is {result.status}, not done.[/]")
    for notice in result.notices:
        console.print(f"[yellow]Note:[/] {notice}")


def _table(title: str) -> Table:
    return Table(title=title, title_justify="left", title_style="bold", box=box.SIMPLE_HEAD)


def _saves(result: Result) -> Table:
    table = _table("Contact, along and across the sliding direction; wear depth of each body")
    for heading in (
        "time\ns",
        "path\nm",
        "p max\nMPa",
        "p centre\nMPa",
        "along\nµm",
        "across\nµm",
        "area\nmm²",
        *(f"{body}\nµm" for body in result.body_names),
    ):
        table.add_column(heading, justify="right", no_wrap=True)
    for save in result.saves():
        table.add_row(
            f"{save['time_s']:g}",
            f"{save['distance_m']:.4g}",
            f"{1e-6 * save['max_pressure_Pa']:.0f}",
            f"{1e-6 * save['centre_pressure_Pa']:.0f}",
            f"{2e6 * save['contact_half_width_x_m']:.0f}",
            f"{2e6 * save['contact_half_width_y_m']:.0f}",
            f"{1e6 * save['contact_area_m2']:.3f}",
            *(
                f"{1e6 * save['bodies'][body]['max_wear_depth_m']:.2f}"
                for body in result.body_names
            ),
        )
    return table


def _first_contact(result: Result) -> str:
    """Return the line that sets the first contact against Hertz and the onset of yield."""
    computed = 1e-6 * result.saves()[0]["max_pressure_Pa"]
    hertz = hertz_contact(result.system)
    if hertz is None:
        return (
            f"First contact: p max {computed:.1f} MPa; no closed form to compare: the surfaces "
            "state no curvature, or the contact is flat."
        )
    p0 = 1e-6 * hertz.peak_pressure
    line = (
        f"First contact: p max {computed:.1f} MPa, Hertz {p0:.1f} MPa "
        f"({100 * (computed / p0 - 1):+.2f} %)"
    )
    if hertz.yield_ratio is not None:
        line += (
            f"; {100 * hertz.yield_ratio:.0f} % of the pressure at which the softer body "
            "first yields beneath the surface (1.6 H/2.8)"
        )
    return line + "."


def _bodies(result: Result) -> Table:
    last = result.saves()[-1]
    table = _table(f"Wear after {last['distance_m']:.4g} m")
    table.add_column("")
    bodies = [_worn(result, name, last) for name in result.body_names]
    for name in result.body_names:
        table.add_column(f"{name} (track)" if result.body(name).swept else name, justify="right")
    for row in bodies[0]:
        cells = [body[row] for body in bodies]
        if any(cell != "-" for cell in cells):
            table.add_row(row, *cells)
    return table


def _worn(result: Result, name: str, save: dict[str, Any]) -> dict[str, str]:
    """Return what a lab would report of one body at the last save."""
    body, worn = result.body(name), save["bodies"][name]
    volume, distance = worn["wear_volume_m3"], save["distance_m"]
    marks = scar(body.wear_depth[-1], result.grid)
    mass = rate = "-"
    if body.density is not None:
        mass = f"{1e6 * mass_from_volume(volume, body.density):.3g}"
    if distance > 0:
        k = specific_wear_rate(volume, result.system.load, distance)
        rate = f"{in_mm3_per_newton_metre(k):.3g}"
    return {
        "volume, mm³": f"{1e9 * volume:.3g}",
        "mass, mg": mass,
        "specific wear rate, mm³/(N·m)": rate,
        "scar along sliding, mm": "whole track" if body.swept else f"{1e3 * marks.along:.3f}",
        "scar across, mm": f"{1e3 * marks.across:.3f}",
        "largest depth, µm": f"{1e6 * worn['max_wear_depth_m']:.3g}",
        "largest plastic depth, µm": f"{1e6 * worn['max_plastic_depth_m']:.3g}",
    }
