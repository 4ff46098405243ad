"""`tribo new`."""

from __future__ import annotations

import tomllib
from pathlib import Path

import click

from tribo.cli.options import PATH
from tribo.templates import TEMPLATES, template

_LISTED = "\n".join(f"  {name:14} {summary}" for name, summary in TEMPLATES.items())
HELP = f"""Write a commented case, study or measurements from TEMPLATE to FILE; - prints it.

\b
Templates:
{_LISTED}
and templates of plugins, which are listed where TEMPLATE is unknown.

\b
Example:
  tribo new ball_on_disk my.toml
"""


@click.command(help=HELP)
@click.argument("name", metavar="TEMPLATE", required=False)
@click.argument("file", type=PATH, required=False)
@click.option("--force", is_flag=True, help="Replace an existing file.")
def new(name: str | None, file: Path | None, force: bool) -> None:
    """Write a template to a file."""
    if name is None:
        raise click.UsageError(f"Missing argument 'TEMPLATE'. Templates:\n{_LISTED}")
    from tribo.core.writing import check_new, write_file
    from tribo.registry.all_plugins import choose

    plugged = None if name in TEMPLATES else choose("tribo_templates", name, "template", TEMPLATES)
    text = plugged.text if plugged else template(name)
    if file is None:
        raise click.UsageError("Missing argument 'FILE'; - prints the template.")
    if file == Path("-"):
        click.echo(text, nl=False)
        return
    check_new(file, force)
    write_file(file, text)
    click.echo(f"Wrote {file}; look it over, then: {_next(text, file)}")


def _next(text: str, file: Path) -> str:
    tables = tomllib.loads(text)
    if "measured" in tables:
        return f"tribo calibrate CASE --measured {file}"
    return f"tribo sweep {file}" if "case" in tables else f"tribo check {file}"
