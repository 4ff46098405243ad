"""`tribo doctor`."""

from __future__ import annotations

from typing import Any

import click

from tribo.cli.options import echo_json

SHORT = ("grid={ size = 0.7e-3, cells = 64 }", "kinematics.duration=20", "output.save_times=[]")
"""What the short run has that differs from the paper's hour."""


@click.command()
@click.option("--json", "as_json", is_flag=True, help="Print a JSON object.")
@click.option(
    "--time-limit",
    type=float,
    metavar="SECONDS",
    help="Allow the import of a plugin this CPU time, by default TRIBO_PLUGIN_TIME_LIMIT, or 30 "
    "times tribo's.",
)
def doctor(as_json: bool, time_limit: float | None) -> None:
    """Test the installation, and try every plugin in a new process.

    Exit codes: 0 all is well, 3 something is not.

    \b
    Example:
      tribo doctor
    """
    from tribo.core.errors import NumericalError
    from tribo.registry.plugins import installed
    from tribo.registry.probe import probe_all
    from tribo.registry.registry import Registry
    from tribo.result.provenance import environment

    registry = Registry(installed())
    records = probe_all(registry.plugins, time_limit)
    checks = _self_test()
    conflicts = registry.conflicts
    found: dict[str, Any] = {
        **environment(),
        "checks": checks,
        "plugins": [record.facts for record in records],
        "conflicts": list(conflicts.values()),
    }
    if as_json:
        echo_json(found)
    else:
        _print(found)
    bad = [check["name"] for check in checks if not check["ok"]]
    bad += [str(r) for r in records if r.status in ("broken", "incompatible")]
    bad += conflicts
    if bad:
        raise NumericalError(f"not well: {', '.join(bad)}")


def _self_test() -> list[dict[str, Any]]:
    """Run a short case and compare it with closed forms, and with itself."""
    import tomllib

    import numpy as np

    from tribo.config.load import validate_case
    from tribo.config.overrides import apply_settings
    from tribo.core.errors import TriboError
    from tribo.lab.against_hertz import hertz_contact
    from tribo.simulation.run import Simulation
    from tribo.templates import template

    try:
        case = validate_case(apply_settings(tomllib.loads(template("ball_on_disk")), SHORT))
        first, second = Simulation(case).run(), Simulation(case).run()
    except TriboError as error:
        return [{"name": "a short run", "ok": False, "detail": str(error)}]
    hertz = hertz_contact(first.system)
    assert hertz is not None
    start, end = first.saves()[0], first.saves()[-1]
    off = start["max_pressure_Pa"] / hertz.peak_pressure - 1
    volume = end["bodies"]["ball"]["wear_volume_m3"]
    balance = abs(volume / (3.11e-16 * 100 * end["distance_m"]) - 1)
    same = bool(np.array_equal(first.field("pressure", -1), second.field("pressure", -1)))
    checks = (
        # On 64 cells the peak lies between cells: 0.1 % is its discretisation.
        ("Hertz peak pressure", abs(off) < 5e-3, f"{100 * off:+.3f} %"),
        ("worn volume = k F s", balance < 1e-10, f"off by {balance:.0e}"),
        ("same case, same bits", same, "equal" if same else "different"),
    )
    return [dict(zip(("name", "ok", "detail"), check, strict=True)) for check in checks]


def _print(found: dict[str, Any]) -> None:
    versions = ", ".join(f"{name} {version}" for name, version in found["packages"].items())
    click.echo(f"Python {found['python']} on {found['platform']}")
    click.echo(versions)
    for check in found["checks"]:
        _line(*check.values())
    for plugin in found["plugins"]:
        name = f"plugin {plugin['distribution']} {plugin['version']} ({plugin['entry_point']})"
        well = plugin["status"] in ("loaded", "disabled")
        _line(name, well, f"{plugin['status']}: {plugin['reason']}".rstrip(": "))
    for conflict in found["conflicts"]:
        _line("name", False, conflict)


def _line(name: str, well: bool, detail: str) -> None:
    click.secho("ok    " if well else "FAILS ", fg="green" if well else "red", nl=False)
    click.echo(f"{name}: {detail}")
