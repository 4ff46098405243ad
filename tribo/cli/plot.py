"""`tribo plot`."""

from __future__ import annotations

from pathlib import Path

import click

from tribo.cli.options import PATH, RESULT


@click.command()
@RESULT
@click.option("-d", "--directory", type=PATH, help="Write to this folder, by default OUTPUT-plots.")
@click.option(
    "--format",
    "suffix",
    type=click.Choice(["png", "pdf", "svg"]),
    default="png",
    show_default=True,
    help="Write pictures in this format.",
)
@click.option(
    "--column",
    "columns",
    multiple=True,
    help="Draw this column of the history alone; may be repeated.",
)
@click.option("--only", "names", multiple=True, help="Write this picture alone; may be repeated.")
@click.option("--animate", is_flag=True, help="Write animation.gif, with pressure and depths.")
@click.option(
    "--against", default="distance_m", show_default=True, help="Draw columns over this one."
)
def plot(
    output: Path,
    directory: Path | None,
    suffix: str,
    columns: tuple[str, ...],
    names: tuple[str, ...],
    animate: bool,
    against: str,
) -> None:
    """Draw the pictures of the result OUTPUT.

    \b
    Example:
      tribo plot my.h5 -d pictures --format pdf
      tribo plot my.h5 --only pressure_map --only ball_scar
      tribo plot my.h5 --column max_pressure_Pa --column bodies.ball.wear_volume_m3
    """
    from functools import partial

    from tribo.plotting.curves import history_curves
    from tribo.plotting.figures import result_picture, save_figures, write_figures
    from tribo.result.read import Result

    folder = directory or output.with_name(output.stem + "-plots")
    paths: list[Path] = []
    with Result.open(output) as result:
        if columns:
            drawn = {"history": partial(history_curves, result, columns, against)}
            paths += write_figures(drawn, folder, suffix)
        if animate:
            from tribo.cli.animation import save_animation

            paths.append(save_animation(result, folder / "animation.gif"))
        if names:
            chosen = {name: partial(result_picture, result, name) for name in names}
            paths += write_figures(chosen, folder, suffix)
        if not (columns or animate or names):
            paths = save_figures(result, folder, suffix, click.echo)
    for path in paths:
        click.echo(f"Wrote {path}")
