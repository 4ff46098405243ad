"""The commands on plugins answer whatever is installed, and keep stdout clean."""

from __future__ import annotations

import json
from importlib import import_module
from pathlib import Path

import pytest
from command_line import tribo
from fake_distributions import OBSERVER, distribute

from tribo.case import Case
from tribo.config.schema import json_schema
from tribo.core.errors import TriboWarning
from tribo.registry.registry import Registry

SCHEMAS = {
    "raises": "raise RuntimeError('no schema today')",
    "exits": "raise SystemExit(0)",
    "is no JSON": "return {'examples': {1, 2}}",
    "is no number": "return {'default': float('nan')}",
    "is nothing": "return None",
}


def code(schema: str = "return handler(source)") -> str:
    made = OBSERVER.format(name="odd.one", title="Odd").replace(
        '= "odd.one"\n',
        '= "odd.one"\n'
        "    @classmethod\n"
        "    def __get_pydantic_json_schema__(cls, source, handler):\n"
        f"        print('a schema is made')\n        {schema}\n",
    )
    return f"print('imported')\n{made}"


def install(folder: Path, distribution: str, code: str) -> None:
    distribute(folder, distribution, "1.0", {"odd.one": distribution}, **{distribution: code})


def test_what_a_plugin_prints_does_not_spoil_the_schema(folder: Path) -> None:
    install(folder, "loud", code())
    done = tribo("--plugins", "odd", "schema")
    assert '"odd.one"' in json.dumps(json.loads(done.stdout))
    assert "imported" in done.stderr
    assert "a schema is made" in done.stderr


@pytest.mark.parametrize("fault", SCHEMAS)
def test_a_configuration_without_a_schema_is_left_out_with_one_line(
    folder: Path, fault: str
) -> None:
    install(folder, "odd_one", code(SCHEMAS[fault]))
    registry = Registry.with_plugins(import_module("odd_one"))
    with pytest.warns(TriboWarning, match=r"^observer 'odd\.one' of odd_one is left out") as caught:
        schema = json_schema(Case, registry)
    assert len(caught) == 1
    assert "odd.one" not in json.dumps(schema)
    assert "progress" in json.dumps(schema)


def test_a_check_of_a_configuration_without_a_schema_says_so(folder: Path) -> None:
    install(folder, "unchecked", code(SCHEMAS["raises"]))
    done = tribo("plugins", "check", "odd.one")
    assert done.returncode == 3
    assert "'odd.one': making the schema of Odd raised RuntimeError: no schema" in done.stderr


@pytest.mark.parametrize(("kind", "status"), [("Path", 0), ("float", 3)])
@pytest.mark.slow
def test_what_needs_a_file_is_left_to_its_own_tests(folder: Path, kind: str, status: int) -> None:
    line = '    type = "odd.one"'
    needing = OBSERVER.format(name="odd.one", title="Odd").replace(
        line, f"    path: {kind}\n{line}"
    )
    install(folder, "reader", f"from pathlib import Path\n{needing}")
    done = tribo("plugins", "check", "reader")
    assert done.returncode == status, done.stderr
    assert ("odd.one: not checked, for want of a file as its path" in done.stdout) == (status == 0)


@pytest.mark.slow
def test_a_conflict_and_a_plugin_to_be_are_told_of_by_each_command(folder: Path) -> None:
    distribute(folder, "to_be", "1.0", {}, ["tribo>=0.1"])
    for name in ("left", "right"):
        install(folder, name, code())
    for verb in ("show", "check"):
        done = tribo("plugins", verb, "odd.one")
        assert done.returncode == 2
        assert "component 'odd.one' is offered by left 1.0 and right 1.0" in done.stderr
    listed = tribo("plugins", "list", "--json")
    assert "conflict" in [row["status"] for row in json.loads(listed.stdout)]
    assert "hint: to_be 1.0 requires tribo but declares no plugin" in listed.stderr
    doctor = tribo("doctor")
    assert doctor.returncode == 3
    assert "'odd.one' is offered by left 1.0 and right 1.0" in doctor.stdout
    assert "hint  to_be 1.0 requires tribo" in doctor.stdout
