"""Run the zoo from the command line, in this process."""

import sys

import pytest
from zoo_keeper import Ended, case_of

from tribo.cli.main import main
from tribo.registry import registry
from tribo.registry.plugins import given


@pytest.fixture
def command(tmp_path, monkeypatch, capsys):
    """Return a function that calls tribo with a zoo as its only plugin."""

    def call(zoo, *args):
        monkeypatch.setattr(registry, "installed", lambda: [given(zoo.plugin())])
        registry.default_registry.cache_clear()
        monkeypatch.chdir(tmp_path)
        monkeypatch.setattr(sys, "argv", ["tribo", *args])
        code = 0
        try:
            main()
        except SystemExit as end:
            code = end.code
        return Ended(code, capsys.readouterr().err.splitlines(), tmp_path / "case.h5")

    yield call
    registry.default_registry.cache_clear()


@pytest.fixture
def run(tmp_path, command):
    """Return a function that runs a case naming some of a zoo."""

    def call(zoo, *classes, **changes):
        (tmp_path / "case.toml").write_text(case_of(*classes, **changes))
        return command(zoo, "run", "case.toml")

    return call
