"""`tribo run`."""

from __future__ import annotations

from pathlib import Path

import click

from tribo.cli.options import CASE, PATH, PLUGIN, SET


@click.command()
@CASE
@click.option("-o", "--output", type=PATH, help="Write this result file, by default CASE.h5.")
@SET
@PLUGIN
@click.option("--force", is_flag=True, help="Replace a result, also of a run that was stopped.")
def run(case: Path, output: Path | None, overrides: tuple[str, ...], force: bool) -> None:
    """Run CASE, a TOML file, and print what a lab would report.

    \b
    Example:
      tribo run my.toml --set grid.cells=128 --set contact.type=winkler -o winkler.h5

    Ctrl-C stops cleanly; 'tribo resume' continues. Exit codes: 0 done, 2 bad
    input, 3 numerical failure or output that cannot be written, 130
    interrupted.
    """
    from tribo.cli.lab_report import print_report
    from tribo.config.load import load_case
    from tribo.core.errors import CaseError
    from tribo.observers.progress import Progress
    from tribo.simulation.run import Simulation
    from tribo.simulation.validity import unusual

    read = load_case(case, overrides=overrides)
    for doubt in unusual(read):
        click.echo(f"warning: {doubt}", err=True)
    simulation = Simulation(read)
    path = output or case.with_suffix(".h5")
    if path.resolve() == case.resolve():
        raise CaseError(f"{path} is the case itself; choose another file with -o")
    with simulation.run(path, observers=[Progress()], overwrite=force) as result:
        print_report(result, warned=True)
        click.echo(f"Saved {path}; see it with: tribo plot {path}")
