"""Each public name of a package has an example, and it runs."""

import doctest
import inspect
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

import tribo
import tribo.testing
from tribo.registry.registry import default_registry

ROOT = Path(__file__).parents[1]
PACKAGES = [path.parent.name for path in sorted(ROOT.glob("plugins/*/src/*/__init__.py"))]


def public():
    """Return the classes and functions of packages by name, and their components by type."""
    named = {}
    for module in (tribo.testing, *map(import_module, PACKAGES)):
        for name in getattr(module, "__all__", ()):
            named[f"{module.__name__}.{name}"] = getattr(module, name)
    registry = default_registry()
    registry.load_all()
    known = registry.components.items()
    return named | {name: c for name, c in known if c.__module__.partition(".")[0] in PACKAGES}


PUBLIC = public()


@pytest.mark.parametrize("name", PUBLIC)
def test_public_name_of_a_package_has_an_example_that_runs(name, monkeypatch):
    thing = inspect.unwrap(PUBLIC[name])
    assert "\nExamples\n--------\n" in inspect.cleandoc(thing.__doc__)
    # What `docs/conf.py` sets up, in the folder that documents are built in.
    monkeypatch.chdir(ROOT)
    runner = doctest.DocTestRunner()
    for test in doctest.DocTestFinder().find(thing, name, globs={"np": np, "tribo": tribo}):
        assert not any(doctest.SKIP in example.options for example in test.examples)
        runner.run(test)
    assert runner.summarize(verbose=False).failed == 0
