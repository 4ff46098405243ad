"""`tribo doctor`."""

from __future__ import annotations

from typing import Any

import click

from tribo.cli.options import echo_json

KNOWN = ("archard_k", "cylinders_crossed", "hardness_below")
"""Cases of `tribo verify` that it computes."""


@click.command()
@click.option("--json", "as_json", is_flag=True, help="Print a JSON object.")
def doctor(as_json: bool) -> None:
    """Test the installation, and try every plugin in a new process.

    Exit codes: 0 all is well, 3 something is not.

    \b
    Example:
      tribo doctor
    """
    from tribo.core.errors import NumericalError
    from tribo.registry.all_plugins import try_out
    from tribo.registry.plugins import installed
    from tribo.result.provenance import environment

    records = installed()
    try_out(records)
    checks = _self_test()
    found: dict[str, Any] = {
        **environment(),
        "checks": checks,
        "plugins": [record.facts for record in records],
    }
    if as_json:
        echo_json(found)
    else:
        _print(found)
    bad = [check["name"] for check in checks if not check["ok"]]
    bad += [str(r) for r in records if r.status in ("broken", "incompatible")]
    if bad:
        raise NumericalError(f"not well: {', '.join(bad)}")


def _self_test() -> list[dict[str, Any]]:
    """Compute known results."""
    from tribo.verification.suite import cases_in, tribo_cases

    cases = [case for case in cases_in(*tribo_cases()) if case.name in KNOWN]
    return [
        {
            "name": f"{row.case}, {row.quantity}",
            "ok": row.verdict == "holds",
            "detail": row.reason if row.error is None else f"off by {row.error:.0e}",
        }
        for case in cases
        for row in case.run()
    ]


def _print(found: dict[str, Any]) -> None:
    versions = ", ".join(f"{name} {version}" for name, version in found["packages"].items())
    click.echo(f"Python {found['python']} on {found['platform']}")
    click.echo(versions)
    for check in found["checks"]:
        _line(*check.values())
    for plugin in found["plugins"]:
        name = f"plugin {plugin['distribution']} {plugin['version']} ({plugin['entry_point']})"
        well = plugin["status"] in ("available", "disabled")
        _line(name, well, f"{plugin['status']}: {plugin['reason']}".rstrip(": "))


def _line(name: str, well: bool, detail: str) -> None:
    click.secho("ok    " if well else "FAILS ", fg="green" if well else "red", nl=False)
    click.echo(f"{name}: {detail}")
