"""`tribo new`."""

from __future__ import annotations

import tomllib
from pathlib import Path

import click

from tribo.cli.options import PATH
from tribo.templates import TEMPLATES, template


@click.command()
@click.argument("name", metavar="[TEMPLATE]", required=False)
@click.argument("file", type=PATH, required=False)
@click.option("--force", is_flag=True, help="Replace an existing file.")
def new(name: str | None, file: Path | None, force: bool) -> None:
    """Write a commented case or measurements from TEMPLATE to FILE.

    Without TEMPLATE it lists the templates, with what plugins offer. A dash for FILE prints the
    template.

    \b
    Example:
      tribo new
      tribo new ball_on_disk my.toml

    Exit codes: 0 done, 2 bad input, 3 output that cannot be written.
    """
    from tribo.core.writing import check_new, write_file
    from tribo.registry.all_plugins import choose

    if name is None:
        _list()
        return
    plugged = None if name in TEMPLATES else choose("tribo_templates", name, "template", TEMPLATES)
    text = plugged.text if plugged else template(name)
    if file is None:
        raise click.UsageError("Missing argument 'FILE'; - prints the template.")
    if file == Path("-"):
        click.echo(text, nl=False)
        return
    check_new(file, force)
    write_file(file, text)
    measured = "measured" in tomllib.loads(text)
    then = f"calibrate CASE --measured {file}" if measured else f"check {file}"
    click.echo(f"Wrote {file}; look it over, then: tribo {then}")


def _list() -> None:
    from tribo.cli.console import Console
    from tribo.core.data_table import LEFT, DataTable, Heading, TableRow
    from tribo.registry.all_plugins import from_all_plugins

    plugged = {each.name: each.summary for each in from_all_plugins("tribo_templates")}
    rows = [TableRow((name, said.rstrip("."))) for name, said in {**TEMPLATES, **plugged}.items()]
    headings = Heading("template"), Heading("contents", form=LEFT)
    Console().table(DataTable("", headings, rows, ["Write one with: tribo new TEMPLATE FILE"]))
