"""`tribo check`."""

from __future__ import annotations

from pathlib import Path

import click

from tribo.cli.options import CASE, JSON, PLUGIN, SET, echo_json
from tribo.cli.streams import harmless
from tribo.core.errors import CaseError, NumericalError


@click.command()
@CASE
@SET
@PLUGIN
@JSON
def check(case: Path, overrides: tuple[str, ...], as_json: bool) -> None:
    """Validate CASE and predict its first contact and its final scar.

    What would go wrong comes first. Nothing is written. The scar is estimated on a coarse grid.

    \b
    Example:
      tribo check my.toml

    Exit codes: 0 nothing found on which the run must stop, 2 bad input, 3
    numerical failure; where it must stop, the code that it would end with.
    """
    from tribo.config.load import load_case
    from tribo.study.check import check_case

    read = load_case(case, overrides=overrides)
    click.echo("first contact, then a trial run on a coarse grid …", err=True)
    found = check_case(read)
    if as_json:
        echo_json(found.as_json())
    else:
        click.echo(harmless(found.text(str(case))))
    for kind in (CaseError, NumericalError):
        if found.exit_code == kind.exit_code:
            raise kind(f"a run of {case} would stop on its way")
