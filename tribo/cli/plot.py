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
@click.option("--only", "names", multiple=True, help="Write this picture alone; may be repeated.")
@click.option("--animate", is_flag=True, help="Write animation.gif, with pressure and depths.")
def plot(
    output: Path,
    directory: Path | None,
    suffix: str,
    names: tuple[str, ...],
    animate: bool,
) -> None:
    """Draw the pictures of the result OUTPUT.

    \b
    Example:
      tribo plot my.h5 -d pictures --format pdf
      tribo plot my.h5 --only pressure_map --only ball_scar
    """
    from functools import partial

    from tribo.plotting.figures import result_picture, save_figures, write_figures
    from tribo.result.read import Result

    folder = directory or output.parent / f"{output.stem}-plots"
    paths: list[Path] = []
    with Result.open(output) as result:
        if animate:
            from tribo.cli.animation import save_animation

            paths.append(save_animation(result, folder / "animation.gif"))
        if names:
            chosen = {name: partial(result_picture, result, name) for name in names}
            paths += write_figures(chosen, folder, suffix)
        if not (animate or names):
            paths = save_figures(result, folder, suffix, click.echo)
    for path in paths:
        click.echo(f"Wrote {path}")
