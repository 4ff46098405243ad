"""`tribo verify`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING

import click

from tribo.cli.options import JSON, PATH, SET, echo_json

if TYPE_CHECKING:
    from tribo.core.data_table import DataTable
    from tribo.verification.convergence import Convergence
    from tribo.verification.reference import Row
    from tribo.verification.refinement import Refinement


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
    from tribo.cli.console import Console
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
        for table in _suite_tables(rows):
            Console().table(table)
        held = sum(row.verdict == "holds" for row in rows)
        absent = len(rows) - held - len(failed)
        click.echo(f"{held} hold, {len(failed)} fail, {absent} need a code that is not installed.")
    if failed:
        raise NumericalError(
            "these fail: " + "; ".join(f"{row.case}: {row.quantity}" for row in failed)
        )


def _verify_case(case: Path, overrides: tuple[str, ...], as_json: bool) -> None:
    from tribo.cli.console import Console
    from tribo.config.load import load_case
    from tribo.simulation.run import Simulation
    from tribo.verification.refinement import refine

    model = Simulation(load_case(case, overrides=overrides)).model
    with _progress(5) as tell:
        study = refine(model, tell)
    if as_json:
        echo_json(asdict(study))
    else:
        Console().table(_study_table(study))


@contextmanager
def _progress(total: int) -> Iterator[Callable[[str], None]]:
    """Show on stderr what runs now, of how many; yield what to tell of each."""
    from tribo.observers.progress import progress_bar

    with progress_bar() as progress:
        task = progress.add_task("", total=total, completed=-1)
        yield lambda what: progress.update(task, advance=1, description=what)


def _suite_tables(rows: Sequence[Row]) -> Iterator[DataTable]:
    """Yield a table for each case, with a row for each quantity."""
    from tribo.core.data_table import DataTable, Heading, TableRow

    headings = (
        *(Heading("quantity"), Heading("expected", form=".5g"), Heading("got", form=".5g")),
        *(Heading("error", form=".1e"), Heading("order"), Heading("verdict")),
    )
    for (case, source), group in groupby(rows, lambda row: (row.case, row.source)):
        lines, notes = [], []
        for row in group:
            order = None if row.order is None else f"{row.order:.2f} ({row.theory:g})"
            verdict = row.verdict.replace("not installed", "absent")
            name = _named(row.quantity, row.unit)
            lines.append(TableRow((name, row.expected, row.got, row.error, order, verdict)))
            if row.verdict == "fails" and row.note:
                notes.append(f"{row.quantity}: {row.note}")
        yield DataTable(f"{case}, {source}", headings, lines, notes, dense=True)


def _study_table(study: Refinement) -> DataTable:
    """Return a row for each estimate, with the uncertainty to quote and where it is from."""
    from tribo.core.data_table import DataTable, Heading, TableRow

    headings = (
        *(Heading("quantity"), Heading("value", form=".5g"), Heading("±", form=".1e")),
        *(
            Heading("%", form=".2f"),
            Heading("grid"),
            Heading("GCI %", form=".2f"),
            Heading("steps"),
        ),
    )
    rows = []
    for each in study.estimates:
        quoted, gci = each.uncertainty, each.grid.gci
        percent = None if quoted is None or not each.value else 100 * quoted / abs(each.value)
        orders = _order(each.grid), None if gci is None else 100 * gci, _order(each.steps)
        rows.append(TableRow((_named(each.name, each.unit), each.value, quoted, percent, *orders)))
    cells = ", ".join(str(level.cells[0]) for level in study.grids)
    steps = ", ".join(str(level.steps) for level in study.steps)
    notes = [
        f"Grids of {cells} cells along x, and {steps} steps; under each, the observed order. "
        "±: the uncertainty to quote, of grid and steps together. GCI: grid convergence index of "
        "the finest grid (Celik et al. 2008)."
    ]
    if any(estimate.uncertainty is None for estimate in study.estimates):
        notes.append(
            "Where values diverge no uncertainty can be quoted: use more cells, or shorter steps."
        )
    return DataTable("", headings, rows, notes, dense=True)


def _order(found: Convergence) -> str:
    if found.order is None:
        return found.behaviour
    order = f"{found.order:.2f}"
    return order if found.behaviour == "converges" else f"{order}, {found.behaviour}"


def _named(name: str, unit: str) -> str:
    return name if unit == "1" else f"{name}, {unit}"
