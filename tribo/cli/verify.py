"""`tribo verify`."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from rich.table import Table

    from tribo.verification.check import Row
    from tribo.verification.convergence import Convergence
    from tribo.verification.refinement import Refinement

NOTHING = "–"
COLOURS = {"holds": "green", "fails": "red", "not installed": "yellow"}


@click.command()
@click.argument("case", required=False, type=click.Path(path_type=Path))
@click.option("--set", "overrides", multiple=True, metavar="PATH=VALUE", help="Change a value.")
@click.option("--only", metavar="TEXT", help="Only checks with TEXT in their name or source.")
@click.option("--json", "as_json", is_flag=True, help="One JSON object, in SI units.")
def verify(case: Path | None, overrides: tuple[str, ...], only: str | None, as_json: bool) -> None:
    """Compare this installation with closed forms, limits and other codes, in about a minute.

    With CASE, run it on three grids and with three lengths of step instead,
    and print the uncertainty to quote with its results.

    \b
    Example:
      tribo verify
      tribo verify --only hertz
      tribo verify my.toml

    Exit codes: 0 all holds, 2 bad input, 3 a check fails or a run of CASE does.
    """
    if case is not None:
        if only is not None:
            raise click.UsageError("--only chooses among the checks; leave it out with a CASE")
        _verify_case(case, overrides, as_json)
    else:
        if overrides:
            raise click.UsageError("--set changes a CASE; name one")
        _verify_installation(only, as_json)


def _verify_installation(only: str | None, as_json: bool) -> None:
    from tribo.core.errors import CaseError, NumericalError
    from tribo.results.provenance import environment
    from tribo.verification.suite import CHECKS, run_suite

    wanted = (only or "").casefold()
    checks = [c for c in CHECKS if wanted in f"{c.case} {c.source}".casefold()]
    if not checks:
        names = "; ".join(check.case for check in CHECKS)
        raise CaseError(f"no check has {only!r} in its name or source; there are: {names}")
    with _progress(sum(check.cost for check in checks)) as tell:
        rows = run_suite(checks, lambda check: tell(check.case, check.cost))
    failed = [row for row in rows if row.verdict == "fails"]
    if as_json:
        found = {**environment(), "holds": not failed, "rows": [asdict(row) for row in rows]}
        click.echo(json.dumps(found, indent=2))
    else:
        _show(_suite_table(rows))
        held = sum(row.verdict == "holds" for row in rows)
        click.echo(f"{held} of {len(rows)} hold, {len(failed)} fail; the rest is not installed.")
    if failed:
        raise NumericalError(
            "these fail: " + "; ".join(f"{row.case}: {row.quantity}" for row in failed)
        )


def _verify_case(case: Path, overrides: tuple[str, ...], as_json: bool) -> None:
    from tribo.config.load import load_case
    from tribo.simulation.run import Simulation
    from tribo.verification.refinement import refine

    model = Simulation(load_case(case, overrides=overrides)).model
    with _progress(5.0) as tell:
        study = refine(model, lambda what: tell(what, 1.0))
    if as_json:
        click.echo(json.dumps(asdict(study), indent=2))
        return
    _show(_case_table(study))
    click.echo(
        f"{_levels(level.cells[0] for level in study.grids)} cells along x, "
        f"{_levels(level.steps for level in study.steps)} steps. p: observed order. "
        "GCI: grid convergence index of the finest level (Celik et al. 2008). "
        "The uncertainty is that of grid and steps together."
    )


@contextmanager
def _progress(total: float) -> Iterator[Callable[[str, float], None]]:
    """Show on stderr what runs now, and the time to go; yield what to tell of it."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    columns = BarColumn(), TimeRemainingColumn(), TextColumn("{task.description}")
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("", total=total)
        running = 0.0

        def tell(what: str, cost: float) -> None:
            nonlocal running
            progress.update(task, advance=running, description=what)
            running = cost

        yield tell


def _show(table: Table) -> None:
    from rich.console import Console

    Console(highlight=False).print(table)


def _table(*columns: str, right: Sequence[str]) -> Table:
    from rich import box
    from rich.table import Table

    table = Table(box=box.SIMPLE_HEAD)
    for name in columns:
        table.add_column(name, justify="right" if name in right else "left", overflow="fold")
    return table


def _suite_table(rows: Sequence[Row]) -> Table:
    columns = ("case", "quantity", "expected", "got", "error", "order", "verdict", "source")
    table = _table(*columns, right=columns[2:6])
    previous = ""
    for row in rows:
        first = row.case != previous
        if first and previous:
            table.add_section()
        previous = row.case
        table.add_row(
            row.case if first else "",
            row.quantity,
            _value(row.expected, row.unit),
            _value(row.got, row.unit),
            NOTHING if row.error is None else f"{row.error:.1e}",
            NOTHING if row.order is None else f"{row.order:.2f} ({row.theory:g})",
            f"[{COLOURS[row.verdict]}]{row.verdict}[/]",
            row.source if first else row.note,
        )
    return table


def _case_table(study: Refinement) -> Table:
    columns = ("quantity", "value", "uncertainty", "%", "grid", "p", "GCI %", "steps", "p ")
    table = _table(*columns, right=("value", "uncertainty", "%", "p", "GCI %", "p "))
    for estimate in study.estimates:
        share = 100 * estimate.uncertainty / abs(estimate.value) if estimate.value else 0.0
        table.add_row(
            estimate.name,
            _value(estimate.value, estimate.unit),
            f"{estimate.uncertainty:.1e}",
            f"{share:.2g}",
            *_words(estimate.grid),
            NOTHING if estimate.grid.gci is None else f"{100 * estimate.grid.gci:.2g}",
            *_words(estimate.steps),
        )
    return table


def _words(found: Convergence) -> tuple[str, str]:
    return found.behaviour, NOTHING if found.order is None else f"{found.order:.2f}"


def _value(value: float | None, unit: str) -> str:
    if value is None:
        return NOTHING
    return f"{value:.5g}" if unit == "1" else f"{value:.5g} {unit}"


def _levels(values: Any) -> str:
    return ", ".join(str(value) for value in values)
