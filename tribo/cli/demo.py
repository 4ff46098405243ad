"""`tribo demo`."""

from __future__ import annotations

from pathlib import Path

import click

from tribo.cli.options import PATH

AVERAGE = """\
This is the paper's model: it averages the disk's wear over the stroke. If the
contact is followed along its stroke, the groove is 6.8 µm deep: the average's is
18 % too deep. docs/paper.md ("What the average costs") says what else that changes,
and kinematics.positions = 33 in the case does it, in some minutes."""


@click.command()
@click.option(
    "-d",
    "--directory",
    type=PATH,
    default="tribo-demo",
    show_default=True,
    help="Folder to write to.",
)
@click.option("--force", is_flag=True, help="Replace the results of an earlier demo.")
def demo(directory: Path, force: bool) -> None:
    """Run the paper's one-hour ball-on-disk test, print its table, draw its pictures.

    \b
    Example:
      tribo demo -d somewhere
    """
    from tribo.cli.report import print_report
    from tribo.config.load import load_case
    from tribo.core.errors import CaseError
    from tribo.core.files import write_whole, writing
    from tribo.observers.progress import Progress
    from tribo.plotting.figures import save_figures
    from tribo.simulation.run import Simulation
    from tribo.templates import template

    case, output = directory / "ball_on_disk.toml", directory / "ball_on_disk.h5"
    with writing(directory):
        for path in (case, output):
            if path.exists() and not force:
                raise CaseError(f"{path} exists; choose another folder with -d, or use --force")
        directory.mkdir(parents=True, exist_ok=True)
        write_whole(case, template("ball_on_disk"))
    click.echo("One hour of a steel ball rubbing on a steel disk: 100 N, 25 Hz, 360 m.")
    simulation = Simulation(load_case(case))
    with simulation.run(output, observers=[Progress()], overwrite=force) as result:
        print_report(result)
        click.echo(AVERAGE)
        pictures = save_figures(result, directory)
    click.echo(f"Case, result and {len(pictures)} pictures are in {directory}/:")
    for path in (case, output, *pictures):
        click.echo(f"  {path.name}")
