"""`tribo check`."""

from __future__ import annotations

from pathlib import Path

import click

from tribo.cli.options import CASE, JSON, PLUGIN, SET, echo_json
from tribo.core.errors import CaseError, NumericalError


@click.command()
@CASE
@SET
@PLUGIN
@JSON
def check(case: Path, overrides: tuple[str, ...], as_json: bool) -> None:
    """Validate CASE and predict its first contact, its final scar, and its size.

    What would go wrong comes first. Nothing is written. The scar is estimated on a coarse grid.

    \b
    Example:
      tribo check my.toml

    Exit codes: 0 nothing found on which the run must stop, 2 bad input, 3
    numerical failure; where it must stop, the code that it would end with.
    """
    from rich.table import Table
    from rich.text import Text

    from tribo.cli.console import Console
    from tribo.cli.waiting import waiting_for
    from tribo.config.load import load_case
    from tribo.study.check import check_case

    found = check_case(load_case(case, overrides=overrides), waiting_for)
    if as_json:
        echo_json(found.as_json())
    else:
        console = Console()
        console.print(f"{case} {found.verdict}", markup=False, soft_wrap=True)
        for heading, rows in found.blocks():
            if heading:
                console.print(f"  {heading}:", markup=False)
            table = Table.grid(padding=(0, 1))
            for row in rows:
                table.add_row(*map(Text, row))
            console.print(table)
    for kind in (CaseError, NumericalError):
        if found.exit_code == kind.exit_code:
            raise kind(f"a run of {case} would stop on its way: {found.data['stops']}")
