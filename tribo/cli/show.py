"""`tribo show`."""

from __future__ import annotations

import json
from pathlib import Path

import click


@click.command()
@click.argument("output", type=click.Path(path_type=Path))
@click.option("--json", "as_json", is_flag=True, help="One JSON object, in SI units.")
def show(output: Path, as_json: bool) -> None:
    """Print the result file OUTPUT: saves, what a lab would report, and what made it.

    \b
    Example:
      tribo show my.h5
      tribo show my.h5 --json
    """
    from tribo.result.read import Result

    with Result.open(output) as result:
        result.check()
        if as_json:
            from tribo.lab.report import lab_report

            lab = lab_report(result).as_json()
            click.echo(json.dumps({**result.summary(), "lab": lab}, indent=2))
            return
        from tribo.cli.report import print_provenance, print_report

        print_report(result)
        print_provenance(result)
