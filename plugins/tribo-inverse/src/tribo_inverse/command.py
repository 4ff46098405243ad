"""`tribo calibrate`."""

from __future__ import annotations

import math
import shlex
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import click
from tribo import CaseError, Finding
from tribo.kernel_api import (
    JSON,
    PATH,
    PLUGIN,
    SET,
    DataTable,
    added_files,
    apply_settings,
    check_new,
    echo_json,
    read_toml,
    to_toml,
    write_file,
)

from tribo_inverse.calibration.calibrate import Calibration
from tribo_inverse.calibration.calibrate import calibrate as fit_numbers
from tribo_inverse.calibration.choice import Choice, choose_case
from tribo_inverse.calibration.measured import Measurements, read_measurements
from tribo_inverse.calibration.plan import Plan, plan_tests
from tribo_inverse.tables import choice_tables, fit_tables, plan_tables, print_all


@click.command()
@click.argument("cases", metavar="CASE...", nargs=-1, required=True, type=PATH)
@click.option(
    "--measured",
    required=True,
    type=PATH,
    help="Read measured values and the numbers to fit from this TOML file.",
)
@SET
@PLUGIN
@click.option(
    "--level",
    type=float,
    default=0.95,
    show_default=True,
    help="Give intervals of this probability.",
)
@click.option(
    "-o",
    "--output",
    type=PATH,
    help="Write the fitted case to a file, and a picture of the fit beside it.",
)
@click.option("--force", is_flag=True, help="Replace existing files.")
@click.option(
    "--plan",
    type=float,
    metavar="PART",
    help="Print instead how many tests give intervals of ± this part, as 0.1.",
)
@JSON
def calibrate(
    cases: tuple[Path, ...],
    measured: Path,
    overrides: tuple[str, ...],
    level: float,
    output: Path | None,
    force: bool,
    plan: float | None,
    as_json: bool,
) -> None:
    """Fit CASE's wear coefficients, or other numbers of it, to measured wear.

    The measured values come from one or more tests, which may differ from CASE or be repeated. The
    command prints estimates with intervals, residuals, warnings about the data, and predictions of
    the fitted case. It compares several cases, of different wear laws say, by Schwarz's criterion.

    \b
    Examples:
      tribo calibrate my.toml --measured weighed.toml -o fitted.toml
      tribo calibrate archard.toml power.toml --measured weighed.toml
      tribo calibrate my.toml --measured planned.toml --plan 0.1
    """
    measurements = read_measurements(measured)
    alternatives = {path.stem: apply_settings(read_toml(path), overrides) for path in cases}
    tables = alternatives[cases[0].stem]
    several = len(cases) > 1
    if measurements.map and (several or plan is not None):
        raise CaseError("local coefficients, [[map]], are fitted in one case, without --plan")
    if several and (output or plan is not None or len(alternatives) < len(cases)):
        raise CaseError(
            "several cases are compared: give files of different names, and --plan or -o with "
            "one case only"
        )
    if several:
        choice = choose_case(alternatives, measurements, level=level, on_run=_print_run_of_case)
        _show(choice, choice_tables(choice), (), as_json)
    elif plan is not None:
        tests = plan_tests(
            tables, measurements, plan, level=level, on_run=partial(_print_run, "run")
        )
        _show(tests, plan_tables(tests), tests.findings, as_json)
    elif measurements.map:
        _fit_local(tables, measurements, level, output, force, as_json)
    else:
        picture = None if output is None else output.with_name(f"{output.stem}-fit.png")
        for file in filter(None, (output, picture)):
            check_new(file, force)
        progress = partial(_print_run, "run")
        found = fit_numbers(tables, measurements, level=level, on_run=progress)
        if output and picture:
            _write(found, output, picture)
        _show(found, fit_tables(found), found.findings, as_json)
        if as_json:
            return
        if output:
            click.echo(f"Wrote {picture}")
            click.echo(f"Run it: tribo run {shlex.quote(str(output))}")
            return
        settings = [word for each in overrides for word in ("--set", each)]
        settings += [word for added in added_files() for word in ("--plugin", added)]
        for path, value in found.settings.items():
            settings += ["--set", f"{path}={value:.4g}"]
        click.echo(f"Run it: {shlex.join(['tribo', 'run', str(cases[0]), *settings])}")


def _fit_local(
    tables: dict[str, Any],
    measurements: Measurements,
    level: float,
    output: Path | None,
    force: bool,
    as_json: bool,
) -> None:
    """Fit local coefficients to a depth map."""
    from tribo_inverse.calibration.mapped import calibrate_map
    from tribo_inverse.map_tables import map_json, map_table, write_map

    if output is not None:
        if output.suffix != ".npz":
            named = f"name it {output.stem}.npz"
            raise CaseError(f"{output}: maps are written as a NumPy archive; {named}")
        check_new(output, force)
    found = calibrate_map(
        tables, measurements.map[0], on_run=partial(_print_run, "run and pass back")
    )
    if as_json:
        echo_json(map_json(found, level))
    else:
        print_all([map_table(found, level)], found.findings)
    if output is not None:
        write_map(found, level, output)


def _write(found: Calibration, case: Path, picture: Path) -> None:
    from tribo.kernel_api import write_figures

    from tribo_inverse.fitted import fit_picture

    write_file(case, to_toml(found.fitted))
    write_figures({picture.stem: lambda: fit_picture(found.data)}, picture.parent)


def _show(
    found: Calibration | Choice | Plan,
    tables: Sequence[DataTable],
    findings: Sequence[Finding],
    as_json: bool,
) -> None:
    """Print a result as JSON, or its tables and findings."""
    if as_json:
        echo_json(found.as_json())
    else:
        print_all(tables, findings)


def _print_run_of_case(name: str, run: int, misfit: float) -> None:
    _print_run(f"{name}, run", run, misfit)


def _print_run(what: str, run: int, misfit: float = math.nan) -> None:
    chi_square = "" if math.isnan(misfit) else f": misfit χ² {misfit:.3g}"
    click.echo(f"{what} {run}{chi_square}", err=True)
