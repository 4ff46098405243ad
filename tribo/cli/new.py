"""`tribo new`."""

from __future__ import annotations

from pathlib import Path

import click

from tribo.cli.options import PATH
from tribo.templates import TEMPLATES, template

HOOK = "tribo_templates"


@click.command()
@click.argument("name", metavar="TEMPLATE")
@click.argument("file", type=PATH)
@click.option("--force", is_flag=True, help="Replace an existing file.")
def new(name: str, file: Path, force: bool) -> None:
    """Write a commented case that runs, from TEMPLATE to FILE.

    \b
    Templates:
      ball_on_disk   the paper's one-hour test
      weighed_split  the same with the loss that was weighed, 10:1
      pin_on_disk    a ball on a turning disk, as in ASTM G99
    and those of plugins, which are listed where TEMPLATE is none of them.

    \b
    Example:
      tribo new ball_on_disk my.toml
    """
    from tribo.core.errors import CaseError
    from tribo.core.files import write_whole, writing
    from tribo.registry.contributions import choose

    text = template(name) if name in TEMPLATES else choose(HOOK, name, "template").text
    with writing(file):
        if file.exists() and not force:
            raise CaseError(f"{file} exists; choose another name, or replace it with --force")
        write_whole(file, text)
    click.echo(f"Wrote {file}; look it over, then: tribo check {file}")
