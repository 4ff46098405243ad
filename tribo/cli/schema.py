"""`tribo schema`."""

from __future__ import annotations

import sys
from contextlib import redirect_stdout

import click

from tribo.cli.options import echo_json


@click.command()
def schema() -> None:
    """Print the JSON Schema of a case, installed plugins included.

    \b
    Example:
      tribo schema > tribo.schema.json
    Then begin a case with '#:schema tribo.schema.json' for help in an editor.
    """
    from tribo.case import Case
    from tribo.config.schema import json_schema

    # Only the schema belongs on stdout, whatever a plugin prints while it is asked for its part.
    with redirect_stdout(sys.stderr):
        found = json_schema(Case)
    echo_json(found)
