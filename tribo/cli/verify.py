"""`tribo verify`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING

import click
import numpy as np

from tribo.cli.options import JSON, SET, echo_json
from tribo.core.data_table import DataTable, Heading, TableRow
from tribo.core.errors import NumericalError
from tribo.core.words import plus_minus

if TYPE_CHECKING:
    from tribo.verification.refinement import Refinement
    from tribo.verification.validation import Row, ValidationCase


@click.command()
@click.argument("case", required=False)
@SET
@click.option("--quick", is_flag=True, help="Take only cases that run in less than a second.")
@click.option("--coverage", is_flag=True, help="List components and their keys that no case uses.")
@JSON
def verify(
    case: str | None, overrides: tuple[str, ...], quick: bool, coverage: bool, as_json: bool
) -> None:
    """Compare this installation with closed forms, other codes and measurements.

    CASE is the name of a case, or how names begin; a folder with cases of your own; or a
    case file, which is run on three grids and with three lengths of step instead, for the
    uncertainty to quote with its results.

    \b
    Example:
      tribo verify
      tribo verify hertz
      tribo verify my_cases/
      tribo verify my.toml

    Exit codes: 0 all holds, 2 bad input, 3 a case fails or a run of a case file does.
    """
    if case is not None and (Path(case).suffix == ".toml" or Path(case).is_file()):
        if quick or coverage:
            raise click.UsageError("--quick and --coverage are of validation, not of a case file")
        _study(Path(case), overrides, as_json)
        return
    if overrides:
        raise click.UsageError("--set changes a case file; name one")
    from tribo.verification.suite import called, cases_in, installed_cases, uncovered

    if case is not None and Path(case).is_dir():
        cases = cases_in(Path(case))
    else:
        cases = called(case or "", installed_cases())
    if not coverage:
        _validate([each for each in cases if each.expected.quick or not quick], as_json)
        return
    missing = uncovered(cases)
    if as_json:
        echo_json({"uncovered": missing})
    if missing:
        raise NumericalError(f"no case uses {', '.join(missing)}")
    if not as_json:
        click.echo(f"Every installed component and key is used by one of {len(cases)} cases.")


def _validate(cases: Sequence[ValidationCase], as_json: bool) -> None:
    from tribo.cli.console import Console
    from tribo.result.provenance import environment

    rows: list[Row] = []
    with _progress(len(cases)) as tell:
        for case in cases:
            tell(case.name)
            rows += case.run()
    failed = [row for row in rows if row.verdict == "fails"]
    if as_json:
        found = {**environment(), "holds": not failed, "rows": [asdict(row) for row in rows]}
        echo_json(found)
    else:
        for table in _tables(rows):
            Console().table(table)
        held = sum(row.verdict == "holds" for row in rows)
        absent = len(rows) - held - len(failed)
        click.echo(f"{held} hold, {len(failed)} fail, {absent} need a solver not installed.")
    if failed:
        raise NumericalError("\n".join(map(str, failed)))


def _study(case: Path, overrides: tuple[str, ...], as_json: bool) -> None:
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


def _tables(rows: Sequence[Row]) -> Iterator[DataTable]:
    from tribo.lab.units import row_name

    forms = {"quantity": "", "expected": ".5g", "got": ".5g", "error": ".1e"}
    forms |= {"order": "", "verdict": ""}
    headings = [Heading(label, form=form) for label, form in forms.items()]
    for title, group in groupby(rows, lambda row: f"{row.case}: {row.title}, {row.source}"):
        lines = []
        for row in group:
            order = None if row.order is None else f"{row.order:.2f} ({row.theory:g})"
            numbers = np.array([row.expected, row.got], float)
            name, size = row_name(row.quantity, row.unit, numbers)
            name += f", {row.solver}" if row.solver else ""
            lines.append(TableRow((name, *numbers / size, row.error, order, row.verdict)))
        yield DataTable(title, headings, lines, dense=True)


def _study_table(study: Refinement) -> DataTable:
    """Return a row for each estimate, with the uncertainty to quote and where it is from."""
    from tribo.lab.units import row_name

    forms = {"quantity": "", "value": ".5g", "±": "", "%": ".2f"}
    forms |= {"grid": ".2f", "GCI %": ".2f", "steps": ".2f"}
    headings = [Heading(label, form=form) for label, form in forms.items()]
    rows = []
    for each in study.estimates:
        gci = None if each.grid.gci is None else 100 * each.grid.gci
        percent = 100 * each.uncertainty / abs(each.value) if each.value else None
        name, size = row_name(each.name, each.unit, each.value)
        shown = plus_minus(each.value / size, each.uncertainty / size)
        orders = each.grid.order, gci, each.steps.order
        rows.append(TableRow((name, *shown, percent, *orders)))
    cells = ", ".join(str(level.cells[0]) for level in study.grids)
    steps = ", ".join(str(level.steps) for level in study.steps)
    notes = [
        f"Grids of {cells} cells along x, and {steps} steps; under each, the observed order. "
        "±: the uncertainty to quote, of grid and steps together. GCI: grid convergence index of "
        "the finest grid (Celik et al. 2008). Without an order the values do not converge, and ± "
        "has three times their range."
    ]
    return DataTable("", headings, rows, notes, dense=True)
