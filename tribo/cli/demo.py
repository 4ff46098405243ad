"""`tribo demo`."""

from __future__ import annotations

from pathlib import Path

import click

from tribo.cli.options import PATH

RESOLVED = ("kinematics.positions=33", "grid.cells=64")
"""What the resolved hour has of its own; 256² cells would take minutes."""
AVERAGE = """\
This is the paper's model: it averages the disk's wear over the stroke.
The same hour follows, with the cycle resolved into 33 positions along the stroke,
on 64² cells; it takes ten to thirty seconds. What differs is on the page "Averaged or resolved
strokes", under "How much it costs"."""


@click.command()
@click.option(
    "-d",
    "--directory",
    type=PATH,
    default="tribo-demo",
    show_default=True,
    help="Write to this folder.",
)
@click.option("--force", is_flag=True, help="Replace the results of an earlier demo.")
def demo(directory: Path, force: bool) -> None:
    """Run the paper's one-hour ball-on-disk test, print its table, draw its pictures.

    First with the paper's average over the stroke, then with the cycle resolved.

    \b
    Example:
      tribo demo -d somewhere
    \b
    On a coarser grid:
      tribo new ball_on_disk my.toml
      tribo run my.toml --set grid.cells=64

    Exit codes: 0 done, 2 bad input, 3 numerical failure or output that cannot
    be written, 130 interrupted.
    """
    from functools import partial

    from tribo.cli.console import Console
    from tribo.cli.lab_report import print_report
    from tribo.config.load import load_case
    from tribo.core.writing import check_new, make_folder, write_file
    from tribo.observers.progress import Progress
    from tribo.plotting.figures import save_figures, write_figures
    from tribo.plotting.overlays import save_overlays
    from tribo.simulation.run import Simulation
    from tribo.study.comparison import Comparison
    from tribo.study.side_by_side import comparison_table
    from tribo.templates import template

    case, output, followed = (
        directory / name for name in ("ball_on_disk.toml", "ball_on_disk.h5", "resolved.h5")
    )
    make_folder(directory)
    for path in (case, output, followed):
        check_new(path, force, "choose another folder with -d, or replace it with --force")
    write_file(case, template("ball_on_disk"))
    click.echo("One hour of a steel ball rubbing on a steel disk: 100 N, 25 Hz, 360 m.")
    averaged = Simulation(load_case(case))
    resolved = Simulation(load_case(case, overrides=RESOLVED))
    with averaged.run(output, observers=[Progress()], overwrite=force) as average:
        print_report(average, warned=True)
        pictures = save_figures(average, directory)
        click.echo(AVERAGE)
        with resolved.run(followed, observers=[Progress()], overwrite=force) as cycle:
            comparison = Comparison({"average": average, "resolved": cycle})
            end = comparison.times[-1:]
            Console().table(comparison_table(comparison, end))
            along = {"disk_resolved": partial(cycle.picture, "disk_profiles")}
            pictures += write_figures(along, directory)
            pictures += save_overlays(comparison.results, end, directory)
    click.echo(f"Case, results and {len(pictures)} pictures are in {directory}/:")
    for path in (case, output, followed, *pictures):
        click.echo(f"  {path.name}")
    click.echo(f"To hand the result on: tribo report {output} (comes with tribo-report)")
