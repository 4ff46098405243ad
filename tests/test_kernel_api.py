"""What the kernel hands out to packages beside the names of `tribo`."""

import ast
import inspect
from pathlib import Path

import pytest

import tribo
from tribo import kernel_api

PLUGINS = Path(tribo.__file__).parents[1] / "plugins"


def names():
    stub = ast.parse(Path(kernel_api.__file__).with_suffix(".pyi").read_text())
    imports = [node for node in stub.body if isinstance(node, ast.ImportFrom)]
    return [alias.asname for node in imports for alias in node.names]


@pytest.mark.parametrize("name", names())
def test_what_it_hands_out_states_what_it_is(name):
    value = getattr(kernel_api, name)
    own = inspect.isfunction(value) and value.__module__.startswith("tribo.")
    assert not own or inspect.getdoc(value)
    assert not inspect.isclass(value) or not value.__doc__.startswith(f"{name}(")


def test_it_hands_out_nothing_that_no_package_needs_and_nothing_of_tribo():
    needed = {
        alias.name
        for path in PLUGINS.glob("*/src/**/*.py")
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.ImportFrom) and node.module == "tribo.kernel_api"
        for alias in node.names
    }
    assert set(names()) == needed
    assert not set(names()) & set(dir(tribo))
