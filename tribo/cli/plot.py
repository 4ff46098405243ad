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
def plot(output: Path, directory: Path | None, suffix: str) -> None:
    """Draw the pictures of the result OUTPUT.

    \b
    Example:
      tribo plot my.h5 -d pictures --format pdf
    """
    from tribo.plotting.figures import save_figures
    from tribo.result.read import Result

    folder = directory or output.with_name(output.stem + "-plots")
    with Result.open(output) as result:
        for path in save_figures(result, folder, suffix):
            click.echo(f"Wrote {path}")
