"""`tribo export`."""

from __future__ import annotations

from pathlib import Path

import click


@click.command()
@click.argument("output", type=click.Path(path_type=Path))
@click.option(
    "-d", "--directory", type=click.Path(path_type=Path), help="Folder to write to; OUTPUT-csv."
)
def export(output: Path, directory: Path | None) -> None:
    """Write history, saves and profiles of the result OUTPUT as CSV.

    The column names carry the units: history.csv (a row a step), saves.csv
    (a row a save), profiles_x.csv and profiles_y.csv (through the centre,
    along and across the sliding direction, a block a save).

    \b
    Example:
      tribo export my.h5 -d csv
    """
    from tribo.results.export import export_csv
    from tribo.results.read import Result

    folder = directory or output.with_name(output.stem + "-csv")
    with Result.open(output) as result:
        for path in export_csv(result, folder):
            click.echo(f"Wrote {path}")
