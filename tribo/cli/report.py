"""The tables a run ends with, in a lab's units."""

from __future__ import annotations

import math

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


def _saves(result: Result) -> Table:
    table = Table(title="Contact", title_justify="left", title_style="bold")
    for heading in (
        "time\ns",
        "path\nm",
        "p max\nMPa",
        "p centre\nMPa",
        "half-width\nalong, µm",
        "half-width\nacross, µm",
        "area\nmm²",
    ):
        table.add_column(heading, justify="right")
    for body in result.body_names:
        table.add_column(f"{body}\ndepth, µm", justify="right")
    for save in result.saves():
        table.add_row(
            f"{save['time_s']:g}",
            f"{save['distance_m']:.4g}",
            f"{1e-6 * save['max_pressure_Pa']:.0f}",
            f"{1e-6 * save['centre_pressure_Pa']:.0f}",
            f"{1e6 * save['contact_half_width_x_m']:.0f}",
            f"{1e6 * save['contact_half_width_y_m']:.0f}",
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
    table = Table(title="Wear", title_justify="left", title_style="bold")
    table.add_column("")
    rows: dict[str, list[str]] = {
        name: []
        for name in (
            "volume, mm³",
            "mass, mg",
            "specific wear rate, mm³/(N·m)",
            "scar along sliding, mm",
            "scar across, mm",
            "largest depth, µm",
            "largest plastic depth, µm",
        )
    }
    distance = last["distance_m"]
    for name in result.body_names:
        body = result.body(name)
        table.add_column(f"{name} (track)" if body.swept else name, justify="right")
        worn = last["bodies"][name]
        volume = worn["wear_volume_m3"]
        rate = (
            specific_wear_rate(volume, result.system.load, distance) if distance > 0 else math.nan
        )
        marks = scar(body.wear_depth[-1], result.grid)
        for row, cell in zip(
            rows.values(),
            (
                f"{1e9 * volume:.3g}",
                "-"
                if body.density is None
                else f"{1e6 * mass_from_volume(volume, body.density):.3g}",
                f"{in_mm3_per_newton_metre(rate):.3g}" if distance > 0 else "-",
                "whole track" if body.swept else f"{1e3 * marks.along:.3f}",
                f"{1e3 * marks.across:.3f}",
                f"{1e6 * worn['max_wear_depth_m']:.3g}",
                f"{1e6 * worn['max_plastic_depth_m']:.3g}",
            ),
            strict=True,
        ):
            row.append(cell)
    for name, cells in rows.items():
        if any(cell != "-" for cell in cells):
            table.add_row(name, *cells)
    return table
