"""Every public class and function, of tribo and of packages, has an example, and it runs."""

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
NAMES = (ROOT / "tests/public_names.txt").read_text(encoding="utf-8").split("\n")[1:-1]
PACKAGES = [path.parent.name for path in sorted(ROOT.glob("plugins/*/src/*/__init__.py"))]


def public():
    """Return public classes and functions by name, and the components of packages by type."""
    named = {f"tribo.{name}": getattr(tribo, name) for name in NAMES}
    for module in (tribo.testing, *map(import_module, PACKAGES)):
        for name in getattr(module, "__all__", ()):
            named[f"{module.__name__}.{name}"] = getattr(module, name)
    registry = default_registry()
    registry.load_all()
    known = registry.components.items()
    named |= {name: c for name, c in known if c.__module__.partition(".")[0] in PACKAGES}
    things = {name: inspect.unwrap(thing) for name, thing in named.items()}
    return {
        n: each for n, each in things.items() if inspect.isclass(each) or inspect.isroutine(each)
    }


PUBLIC = public()


@pytest.mark.parametrize("name", PUBLIC)
def test_public_name_has_an_example_that_runs(name, monkeypatch):
    assert "\nExamples\n--------\n" in inspect.cleandoc(PUBLIC[name].__doc__)
    # What `docs/conf.py` sets up, in the folder that documents are built in.
    monkeypatch.chdir(ROOT)
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    for test in doctest.DocTestFinder().find(PUBLIC[name], name, globs={"np": np, "tribo": tribo}):
        assert not any(doctest.SKIP in example.options for example in test.examples)
        runner.run(test)
    assert runner.summarize(verbose=False).failed == 0
