"""Packages for another contract are named, and hurt no case that does not name them."""

import json
import sys

import pytest
from command_line import tribo
from fake_distributions import SHORT, distribute, observer, plugins

import tribo as package
from tribo.registry.hookspecs import GROUP
from tribo.registry.registry import default_registry
from tribo.templates import template

GROUPS = ("tribo", "tribo.v1.observer", "tribo.3")
"""Groups of entry points of other contracts."""


@pytest.fixture
def other(folder, request, monkeypatch):
    """A package for another contract, with a component and with hooks, whose import fails."""
    group = getattr(request, "param", "tribo")
    points = {"other.calm": "other", "other": "other_hooks"}
    distribute(folder, "other", "4.5", points, group=group, other="1 / 0", other_hooks="1 / 0")
    monkeypatch.setenv("TRIBO_PLUGINS", "other")
    return group


@pytest.mark.slow
@pytest.mark.parametrize("other", GROUPS, indirect=True)
def test_a_case_that_names_another_contract_is_refused_and_no_other_is(folder, other):
    case = template("ball_on_disk")
    (folder / "plain.toml").write_text(case)
    (folder / "named.toml").write_text(f'observers = ["other.calm"]\n{case}')
    plain = tribo("run", "plain.toml", *SHORT, cwd=folder)
    assert (plain.returncode, "other" in plain.stderr) == (0, False)
    named = tribo("run", "named.toml", cwd=folder)
    assert named.returncode == 2
    (line,) = named.stderr.splitlines()
    assert "observers.1: " in line
    assert "'other.calm' cannot be used: other 4.5 is incompatible: " in line
    assert repr(other) in line
    assert f"contract {package.api_version}" in line
    assert "The contract of plugins" in line
    assert "other" not in sys.modules


@pytest.mark.slow
def test_lists_the_doctor_and_commands_name_another_contract(folder, other):
    listed = json.loads(tribo("plugins", "list", "--json").stdout)
    (reason,) = {row["reason"] for row in listed if row["status"] == "incompatible"}
    for words, code in (
        (("doctor",), 3),
        (("plugins", "show", "other.calm"), 2),
        (("export", "no.h5", "--format", "other.format"), 2),
        (("new", "other.case"), 2),
        (("other",), 2),
    ):
        done = tribo(*words, cwd=folder)
        assert done.returncode == code, words
        assert reason in done.stdout + " ".join(done.stderr.split()), words
    assert "incompatible" not in tribo("--help").stderr


def test_a_package_for_several_contracts_is_used_by_ours(folder):
    points = {"both.calm": "both"}
    distribute(folder, "both", "1.0", {"both.old": "both_old"}, group="tribo", both_old="1 / 0")
    (lines,) = folder.glob("both-*/entry_points.txt")
    lines.write_text(f"{lines.read_text()}[{GROUP}]\nboth.calm = both\n")
    (folder / "both.py").write_text(observer("both.calm"))
    (plugin,) = plugins("both")
    assert (plugin.names, plugin.usable) == (tuple(points), True)
    assert default_registry().lookup("observer", "both.calm").type == "both.calm"
