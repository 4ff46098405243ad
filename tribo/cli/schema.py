"""`tribo schema`."""

from __future__ import annotations

import json

import click


@click.command()
def schema() -> None:
    """Print the JSON Schema of a case, installed plugins included.

    \b
    Example:
      tribo schema > tribo.schema.json
    Then begin a case with '#:schema tribo.schema.json' for help in an editor.
    """
    from tribo.config.case import Case
    from tribo.config.schema import json_schema
    from tribo.registry.loader import builtin, installed
    from tribo.registry.probe import probe_all
    from tribo.registry.registry import Registry
    from tribo.registry.selection import selected

    # The schema needs every plugin's code; one that cannot be imported is left out.
    registry = Registry([builtin(), *probe_all(selected(installed()))])
    for plugin in registry.plugins:
        if plugin.status in ("broken", "incompatible", "conflict"):
            click.echo(f"warning: {plugin} is left out: {plugin.reason}", err=True)
    click.echo(json.dumps(json_schema(Case, registry), indent=2))
