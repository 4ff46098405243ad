"""`tribo verify`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

import click

from tribo.cli.options import JSON, PATH, SET, echo_json

if TYPE_CHECKING:
    from rich.table import Table

    from tribo.verification.convergence import Convergence
    from tribo.verification.reference import Row
    from tribo.verification.refinement import Refinement

NOTHING = "–"
VERDICTS = {
    "holds": "[green]holds[/]",
    "fails": "[red]fails[/]",
    "not installed": "[dim]absent[/]",
}


@click.command()
@click.argument("case", required=False, type=PATH)
@SET
@click.option("--only", metavar="TEXT", help="Only checks with TEXT in their name or source.")
@JSON
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
    from tribo.result.provenance import environment
    from tribo.verification.suite import references

    wanted = (only or "").casefold()
    known_cases = references()
    chosen = [known for known in known_cases if wanted in f"{known.case} {known.source}".casefold()]
    if not chosen:
        names = "; ".join(known.case for known in known_cases)
        raise CaseError(f"no check has {only!r} in its name or source; there are: {names}")
    rows = []
    with _progress(len(chosen)) as tell:
        for known in chosen:
            tell(known.case)
            rows += known.run()
    failed = [row for row in rows if row.verdict == "fails"]
    if as_json:
        found = {**environment(), "holds": not failed, "rows": [asdict(row) for row in rows]}
        echo_json(found)
    else:
        _print_suite(rows)
        held = sum(row.verdict == "holds" for row in rows)
        absent = len(rows) - held - len(failed)
        click.echo(f"{held} hold, {len(failed)} fail, {absent} need a code that is not installed.")
    if failed:
        raise NumericalError(
            "these fail: " + "; ".join(f"{row.case}: {row.quantity}" for row in failed)
        )


def _verify_case(case: Path, overrides: tuple[str, ...], as_json: bool) -> None:
    from tribo.config.load import load_case
    from tribo.simulation.run import Simulation
    from tribo.verification.refinement import refine

    model = Simulation(load_case(case, overrides=overrides)).model
    with _progress(5) as tell:
        study = refine(model, tell)
    if as_json:
        echo_json(asdict(study))
        return
    _print_study(study)


@contextmanager
def _progress(total: int) -> Iterator[Callable[[str], None]]:
    """Show on stderr what runs now, of how many; yield what to tell of each."""
    from tribo.observers.progress import progress_bar

    with progress_bar() as progress:
        task = progress.add_task("", total=total, completed=-1)
        yield lambda what: progress.update(task, advance=1, description=what)


def _print_suite(rows: Sequence[Row]) -> None:
    from itertools import groupby

    from tribo.cli.console import Console

    console = Console(highlight=False)
    console.print(_suite_table([], header=True))
    for (case, source), group in groupby(rows, lambda row: (row.case, row.source)):
        console.print(f"[bold]{case}[/]  [dim]{source}[/]")
        console.print(_suite_table(list(group), header=False))


def _suite_table(rows: Sequence[Row], *, header: bool) -> Table:
    table = _table(header=header, quantity=0, expected=10, got=10, error=7, order=11, verdict=7)
    for row in rows:
        table.add_row(
            f"  {_named(row.quantity, row.unit)}",
            _number(row.expected, ".5g"),
            _number(row.got, ".5g"),
            _number(row.error, ".1e"),
            NOTHING if row.order is None else f"{row.order:.2f} ({row.theory:g})",
            VERDICTS[row.verdict],
        )
        if row.verdict == "fails" and row.note:
            table.add_row(f"    [dim]{row.note}[/]")
    return table


def _print_study(study: Refinement) -> None:
    from tribo.cli.console import Console

    widths = {"value": 10, "±": 7, "%": 6, "grid": 10, "GCI %": 6, "steps": 10}
    table = _table(header=True, quantity=0, **widths)
    for estimate in study.estimates:
        quoted = estimate.uncertainty
        table.add_row(
            _named(estimate.name, estimate.unit),
            f"{estimate.value:.5g}",
            _number(quoted, ".1e"),
            _percent(quoted, estimate.value),
            _order(estimate.grid),
            _percent(estimate.grid.gci),
            _order(estimate.steps),
        )
    console = Console(highlight=False)
    console.print(table)
    cells = ", ".join(str(level.cells[0]) for level in study.grids)
    steps = ", ".join(str(level.steps) for level in study.steps)
    console.print(
        f"Grids of {cells} cells along x, and {steps} steps; under each, the observed order. "
        "±: the uncertainty to quote, of grid and steps together. GCI: grid convergence index of "
        "the finest grid (Celik et al. 2008)."
    )
    if any(estimate.uncertainty is None for estimate in study.estimates):
        console.print(
            "Where values diverge no uncertainty can be quoted: use more cells, or shorter steps."
        )


def _table(*, header: bool, **widths: int) -> Table:
    """Return a table of which the first column takes what the others leave."""
    from rich.table import Table

    table = Table(box=None, expand=True, show_header=header, padding=(0, 0, 0, 1))
    for name, width in widths.items():
        if width:
            table.add_column(name, justify="right", width=width)
        else:
            table.add_column(name, ratio=1, overflow="fold")
    return table


def _order(found: Convergence) -> str:
    if found.order is None:
        return found.behaviour
    order = f"{found.order:.2f}"
    return order if found.behaviour == "converges" else f"{order}, {found.behaviour}"


def _percent(part: float | None, of: float = 1.0) -> str:
    return NOTHING if part is None or not of else f"{100 * part / abs(of):.2f}"


def _number(value: float | None, form: str) -> str:
    return NOTHING if value is None else format(value, form)


def _named(name: str, unit: str) -> str:
    return name if unit == "1" else f"{name}, {unit}"
