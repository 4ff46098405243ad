"""`tribo materials`."""

from __future__ import annotations

import click

from tribo.cli.options import echo_json


@click.command()
@click.argument("name", required=False)
@click.option("--json", "as_json", is_flag=True, help="Print a JSON object, in the sources' units.")
def materials(name: str | None, as_json: bool) -> None:
    """List the materials that a case may name, or the numbers of NAME with their sources.

    Of a range a case takes the middle, if no value is said to be taken. Wear rates
    are shown for comparison; a case takes none of them.

    \b
    Example:
      tribo materials
      tribo materials 100Cr6
    """
    from tribo.core.material import in_words, materials

    known = dict([materials.known(name)]) if name else materials.tables()
    if as_json:
        echo_json(known)
        return
    for called, table in known.items():
        click.echo(f"{called:14} {table['summary']}")
        for key, number in table.items() if name else ():
            if isinstance(number, dict):
                click.echo(f"  {key}: {in_words(number)}\n    {'; '.join(number['sources'])}")
