"""`tribo show`."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path

import click

from tribo.cli.options import JSON, RESULT, echo_json


@click.command()
@RESULT
@JSON
def show(output: Path, as_json: bool) -> None:
    """Print the result file OUTPUT: saves, what a lab would report, and what made it.

    \b
    Example:
      tribo show my.h5
      tribo show my.h5 --json
    """
    from tribo.cli.lab_report import print_report, provenance_rows
    from tribo.cli.streams import harmless
    from tribo.lab.report import lab_report
    from tribo.result.read import Result
    from tribo.result.summary import summary

    with Result.open(output) as result:
        if as_json:
            printed = summary(result)
            lab = lab_report(result)
            found = [asdict(each) for each in result.findings]
            echo_json({**printed, "findings": found, "lab": lab.as_json()})
        else:
            print_report(result)
            click.echo()
            for name, words in provenance_rows(result):
                click.echo(harmless(f"{name}: {words}"))
