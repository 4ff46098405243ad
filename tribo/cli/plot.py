"""`tribo plot`."""

from __future__ import annotations

from pathlib import Path

import click

from tribo.cli.options import PATH, RESULT


@click.command()
@RESULT
@click.option("-d", "--directory", type=PATH, help="Folder to write to; OUTPUT-plots.")
@click.option(
    "--format", "suffix", type=click.Choice(["png", "pdf", "svg"]), default="png", show_default=True
)
@click.option(
    "--column", "columns", multiple=True, help="Draw this column of the history alone; repeatable."
)
@click.option("--against", default="distance_m", show_default=True, help="Over this column.")
def plot(
    output: Path, directory: Path | None, suffix: str, columns: tuple[str, ...], against: str
) -> None:
    """Draw the pictures of the result OUTPUT.

    \b
    Example:
      tribo plot my.h5 -d pictures --format pdf
      tribo plot my.h5 --column max_pressure_Pa --column bodies.ball.wear_volume_m3
    """
    from functools import partial

    from tribo.plotting.curves import history_curves
    from tribo.plotting.figures import save_figures, write_figures
    from tribo.result.read import Result

    folder = directory or output.with_name(output.stem + "-plots")
    with Result.open(output) as result:
        if columns:
            drawn = {"history": partial(history_curves, result, columns, against)}
            paths = write_figures(drawn, folder, suffix)
        else:
            paths = save_figures(result, folder, suffix)
    for path in paths:
        click.echo(f"Wrote {path}")
