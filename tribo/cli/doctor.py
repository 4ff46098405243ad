"""`tribo doctor`."""

from __future__ import annotations

from typing import Any

import click

from tribo.cli.options import echo_json


@click.command()
@click.option("--json", "as_json", is_flag=True, help="Print a JSON object.")
def doctor(as_json: bool) -> None:
    """Print versions, and try every plugin in a new process.

    Exit codes: 0 all is well, 3 something is not.

    \b
    Example:
      tribo doctor
    """
    from tribo.core.compiled import compiled
    from tribo.core.errors import NumericalError
    from tribo.registry.all_plugins import try_out
    from tribo.registry.plugins import installed
    from tribo.result.provenance import environment

    records = installed()
    try_out(records)
    fast = compiled()
    lines = [fast.check()] if fast else []
    found: dict[str, Any] = {
        **environment(),
        "checks": [{"name": name, "ok": well, "detail": why} for name, well, why in lines],
        "plugins": [record.facts for record in records],
    }
    for record in records:
        name = f"plugin {record} ({record.facts['entry_point']})"
        reason = f"{record.status}: {record.reason}".rstrip(": ")
        lines.append((name, record.usable or record.status == "disabled", reason))
    if as_json:
        echo_json(found)
    else:
        versions = ", ".join(f"{name} {version}" for name, version in found["packages"].items())
        click.echo(f"Python {found['python']} on {found['platform']}, {versions}")
        for name, well, detail in lines:
            click.secho("ok    " if well else "FAILS ", fg="green" if well else "red", nl=False)
            click.echo(f"{name}: {detail}")
    if bad := [name for name, well, _ in lines if not well]:
        raise NumericalError(f"not well: {', '.join(bad)}")
