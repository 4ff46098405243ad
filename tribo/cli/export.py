"""`tribo export`."""

from __future__ import annotations

from pathlib import Path

import click

from tribo.cli.options import PATH, RESULT


@click.command()
@RESULT
@click.option("-d", "--directory", type=PATH, help="Folder to write to; OUTPUT-FORMAT.")
@click.option(
    "--format", "name", default="csv", show_default=True, help="csv, or one that a plugin offers."
)
def export(output: Path, directory: Path | None, name: str) -> None:
    """Write the result OUTPUT in another format: CSV, or one that a plugin offers.

    CSV holds history, saves and profiles, and its column names carry the units:
    history.csv (a row a step), saves.csv (a row a save, with the largest value of
    each field of effects and laws and its mean in the contact), profiles_x.csv
    and profiles_y.csv (through the centre, along and across the sliding
    direction, a block a save).

    \b
    Example:
      tribo export my.h5 -d csv
    """
    from tribo.core.writing import writing
    from tribo.registry.all_plugins import choose
    from tribo.result.export import export_csv
    from tribo.result.read import Result

    write = export_csv
    if name != "csv":
        write = choose("tribo_export_formats", name, "format", {"csv": "tables"}).write
    folder = directory or output.with_name(f"{output.stem}-{name}")
    with Result.open(output) as result:
        with writing(folder):
            paths = write(result, folder)
        for path in paths:
            click.echo(f"Wrote {path}")
