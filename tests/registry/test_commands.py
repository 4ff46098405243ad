"""The commands on plugins answer whatever is installed, and keep stdout clean."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest
from fake_distributions import OBSERVER, distribute

import tribo
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


def code(name: str, schema: str = "return handler(source)") -> str:
    made = OBSERVER.format(name=name, title="Odd").replace(
        f'= "{name}"\n',
        f'= "{name}"\n'
        "    @classmethod\n"
        "    def __get_pydantic_json_schema__(cls, source, handler):\n"
        f"        print('a schema is made')\n        {schema}\n",
    )
    return f"print('imported')\n{made}"


def command(folder: Path, *args: str) -> subprocess.CompletedProcess[str]:
    path = os.pathsep.join([str(folder), str(Path(tribo.__file__).parents[1])])
    return subprocess.run(
        [sys.executable, "-m", "tribo", *args],
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
        timeout=100,
        check=False,
    )


def install(folder: Path, distribution: str, code: str) -> None:
    distribute(folder, distribution, "1.0", {"odd.one": distribution}, **{distribution: code})


def test_what_a_plugin_prints_does_not_spoil_the_schema(tmp_path: Path) -> None:
    install(tmp_path, "loud", code("odd.one"))
    done = command(tmp_path, "--plugins", "odd", "schema")
    assert '"odd.one"' in json.dumps(json.loads(done.stdout))
    assert "imported" in done.stderr


@pytest.mark.parametrize("fault", list(SCHEMAS))
def test_a_configuration_without_a_schema_is_left_out_with_one_line(
    folder: Path, fault: str
) -> None:
    name = f"odd_{fault.replace(' ', '_')}"
    install(folder, name, code("odd.one", SCHEMAS[fault]))
    registry = Registry.with_plugins(import_module(name))
    with pytest.warns(TriboWarning) as caught:
        schema = json_schema(Case, registry)
    assert "odd.one" not in json.dumps(schema)
    assert "progress" in json.dumps(schema)
    (warning,) = caught
    assert str(warning.message).startswith(f"observer 'odd.one' of {name} is left out: ")


def test_a_check_of_a_configuration_without_a_schema_says_so(tmp_path: Path) -> None:
    install(tmp_path, "unchecked", code("odd.one", SCHEMAS["raises"]))
    done = command(tmp_path, "plugins", "check", "odd.one")
    assert done.returncode == 3
    (line,) = [line for line in done.stderr.splitlines() if line.startswith("error")]
    assert "'odd.one'" in line
    assert "making the schema of Odd raised RuntimeError: no schema today" in line


@pytest.mark.parametrize(("kind", "status"), [("Path", 0), ("float", 3)])
def test_what_needs_a_file_is_left_to_its_own_tests(tmp_path: Path, kind: str, status: int) -> None:
    line = '    type = "odd.one"'
    needing = OBSERVER.format(name="odd.one", title="Odd").replace(
        line, f"    path: {kind}\n{line}"
    )
    install(tmp_path, "reader", f"from pathlib import Path\n{needing}")
    done = command(tmp_path, "plugins", "check", "reader")
    assert done.returncode == status, done.stderr
    left = "odd.one: not checked, for want of a file as its path; the tests of reader have to"
    assert (left in done.stdout) == (status == 0)


def test_a_name_in_conflict_is_shown_and_checked_with_both_named(tmp_path: Path) -> None:
    for name in ("left", "right"):
        install(tmp_path, name, code("odd.one"))
    for verb in ("show", "check"):
        done = command(tmp_path, "plugins", verb, "odd.one")
        assert done.returncode == 2
        last = done.stderr.splitlines()[-1]
        assert last.startswith("error: component 'odd.one' is offered by left 1.0 and right 1.0")
        assert "uninstall or disable one of them" in last
    rows = json.loads(command(tmp_path, "plugins", "list", "--json").stdout)
    in_conflict = {r["distribution"] for r in rows if r["status"] == "conflict"}
    assert in_conflict == {"left", "right"}
    doctor = command(tmp_path, "doctor")
    assert doctor.returncode == 3
    assert "'odd.one' is offered by left 1.0 and right 1.0" in doctor.stdout


def test_a_plugin_to_be_is_hinted_at(tmp_path: Path) -> None:
    distribute(tmp_path, "to_be", "1.0", {}, ["tribo>=0.1"])
    listed = command(tmp_path, "plugins", "list", "--json")
    assert "hint: to_be 1.0 requires tribo but declares no plugin" in listed.stderr
    json.loads(listed.stdout)
    assert "hint  to_be 1.0 requires tribo" in command(tmp_path, "doctor").stdout
