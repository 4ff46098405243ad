"""Run the zoo from the command line, in this process."""

import pytest
from command_line import tribo
from zoo_keeper import case_of

from tribo.registry import registry
from tribo.registry.plugins import given


@pytest.fixture
def command(tmp_path, monkeypatch):
    """Return a function that calls tribo with a zoo as its only plugin."""
    monkeypatch.chdir(tmp_path)

    def call(zoo, *args):
        monkeypatch.setattr(registry, "installed", lambda: [given(zoo.plugin())])
        registry.default_registry.cache_clear()
        return tribo(*args)

    yield call
    registry.default_registry.cache_clear()


@pytest.fixture
def run(tmp_path, command):
    """Return a function that runs a case naming some of a zoo."""

    def call(zoo, *classes, **changes):
        (tmp_path / "case.toml").write_text(case_of(*classes, **changes))
        return command(zoo, "run", "case.toml")

    return call
