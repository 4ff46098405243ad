"""`tribo doctor`."""

from __future__ import annotations

from typing import Any

import click

from tribo.cli.options import echo_json


@click.command()
@click.option("--json", "as_json", is_flag=True, help="One JSON object.")
@click.option(
    "--time-limit",
    type=float,
    metavar="SECONDS",
    help="What a plugin's import may take.  [default: TRIBO_PLUGIN_TIME_LIMIT, or 20]",
)
def doctor(as_json: bool, time_limit: float | None) -> None:
    """Test the installation, and try every plugin anew, in a process of its own.

    Exit codes: 0 all is well, 3 something is not.

    \b
    Example:
      tribo doctor
    """
    from concurrent.futures import ThreadPoolExecutor

    from tribo.core.errors import NumericalError
    from tribo.registry.plugins import installed, undeclared
    from tribo.registry.probe import probe
    from tribo.registry.registry import Registry
    from tribo.result.provenance import environment
    from tribo.simulation.selftest import self_test

    with ThreadPoolExecutor(2) as pool:
        registry = Registry(installed())
        records = list(pool.map(lambda plugin: probe(plugin, time_limit), registry.plugins))
    checks = self_test()
    conflicts = registry.conflicts
    found: dict[str, Any] = {
        **environment(),
        "checks": [{"name": c.name, "ok": c.ok, "detail": c.detail} for c in checks],
        "plugins": [record.facts for record in records],
        "conflicts": list(conflicts.values()),
        "hints": undeclared(),
    }
    if as_json:
        echo_json(found)
    else:
        _print(found)
    bad = [check.name for check in checks if not check.ok]
    bad += [str(r) for r in records if r.status in ("broken", "incompatible")]
    bad += conflicts
    if bad:
        raise NumericalError(f"not well: {', '.join(bad)}")


def _print(found: dict[str, Any]) -> None:
    versions = ", ".join(f"{name} {version}" for name, version in found["packages"].items())
    click.echo(f"Python {found['python']} on {found['platform']}")
    click.echo(versions)
    for check in found["checks"]:
        _line(check["ok"], check["name"], check["detail"])
    for plugin in found["plugins"]:
        name = f"plugin {plugin['distribution']} {plugin['version']} ({plugin['entry_point']})"
        well = plugin["status"] in ("loaded", "disabled")
        _line(well, name, f"{plugin['status']}: {plugin['reason']}".rstrip(": "))
    for conflict in found["conflicts"]:
        _line(False, "name", conflict)
    for hint in found["hints"]:
        click.echo(f"hint  {hint}")


def _line(well: bool, name: str, detail: str) -> None:
    click.secho("ok    " if well else "FAILS ", fg="green" if well else "red", nl=False)
    click.echo(f"{name}: {detail}")
