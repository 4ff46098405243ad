"""`tribo export`."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import click

from tribo.cli.options import PATH, RESULT
from tribo.core.errors import CaseError
from tribo.core.words import unknown

OWN = ("csv", "xlsx")


@click.command()
@RESULT
@click.option("-d", "--directory", type=PATH, help="Write to a folder, by default OUTPUT-FORMAT.")
@click.option(
    "--format",
    "name",
    default="csv",
    show_default=True,
    help="Write csv, xlsx, or a plugin's format.",
)
@click.option("--columns", metavar="A,B,…", help="Write these columns of lab.csv alone.")
def export(output: Path, directory: Path | None, name: str, columns: str | None) -> None:
    """Write the result OUTPUT as CSV, for Excel, or in a format that a plugin offers.

    lab.csv has what 'tribo show' prints of the saves, in a laboratory's units. The
    other files are in SI: history.csv (a row a step) and saves.csv (a row a save). For
    Excel they are sheets of tables.xlsx.

    \b
    Example:
      tribo export my.h5 -d csv
      tribo export my.h5 --format xlsx --columns "time,p max,ball depth"
    """
    from tribo.core.writing import writing
    from tribo.lab.tables import saves_table
    from tribo.registry.all_plugins import choose
    from tribo.result.export import write_tables
    from tribo.result.read import Result

    write = None if name in OWN else choose("tribo_export_formats", name, "format", OWN).write
    if write and columns:
        raise CaseError(f"they belong to --format csv or xlsx, not to {name}", "--columns")
    folder = directory or output.parent / f"{output.stem}-{name}"
    with Result.open(output) as result:
        lab = saves_table(result).to_dataframe()
        tables: dict[str, Any] = {"lab": lab[_chosen(columns, lab)] if columns else lab}
        if not (write or columns):
            tables |= {name: result.table(name) for name in ("history", "saves")}
        with writing(folder):
            paths = write(result, folder) if write else write_tables(tables, folder, name)
        for path in paths:
            click.echo(f"Wrote {path}")


def _chosen(columns: str, there: Iterable[str]) -> list[str]:
    """Return the columns of a list of names without units."""
    names = {column.partition(" (")[0]: column for column in there}
    try:
        return [names[each.strip()] for each in columns.split(",")]
    except KeyError as error:
        raise CaseError(unknown("column", error.args[0], names), "--columns") from None
