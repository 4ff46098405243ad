"""`tribo demo`."""

from __future__ import annotations

from pathlib import Path

import click

from tribo.cli.options import PATH

RESOLVED = ("kinematics.positions=average,33", "grid.cells=64")
"""What varies afterwards, and its grid; 256² cells would take minutes."""
AVERAGE = f"""\
This is the paper's model: it averages the disk's wear over the stroke. What differs if the stroke
is resolved into 33 positions is on the page "Averaged or resolved strokes"; it takes ten to thirty
seconds to compute: tribo compare ball_on_disk.toml --vary {RESOLVED[0]} --set {RESOLVED[1]}"""


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
@click.pass_context
def demo(ctx: click.Context, directory: Path, force: bool) -> None:
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
    from tribo.cli.compare import compare
    from tribo.cli.plot import plot
    from tribo.cli.run import run
    from tribo.core.writing import check_new, make_folder, write_file
    from tribo.templates import template

    case, output = directory / "ball_on_disk.toml", directory / "ball_on_disk.h5"
    make_folder(directory)
    for path in (case, output):
        check_new(path, force, "choose another folder with -d, or replace it with --force")
    write_file(case, template("ball_on_disk"))
    click.echo("One hour of a steel ball rubbing on a steel disk: 100 N, 25 Hz, 360 m.")
    ctx.invoke(run, case=case, output=output, force=force)
    ctx.invoke(plot, output=output, directory=directory)
    click.echo(AVERAGE)
    varied, grid = RESOLVED
    ctx.invoke(compare, files=(case,), vary=(varied,), overrides=(grid,), at=("1 h",))
    click.echo(f"To hand the result on: tribo report {output} (comes with tribo-report)")
