"""Every public class and function has an example, and it runs."""

import doctest
import inspect
from pathlib import Path

import numpy as np
import pytest

import tribo

NAMES = Path(__file__).with_name("public_names.txt").read_text(encoding="utf-8").split("\n")[1:-1]


@pytest.mark.parametrize("name", NAMES)
def test_public_name_has_an_example_that_runs(name, monkeypatch):
    thing = inspect.unwrap(getattr(tribo, name))
    if not (inspect.isclass(thing) or inspect.isroutine(thing)):
        return
    assert "\nExamples\n--------\n" in inspect.cleandoc(thing.__doc__)
    # What `docs/conf.py` sets up, in the folder that documents are built in.
    monkeypatch.chdir(Path(__file__).parents[1])
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    for test in doctest.DocTestFinder().find(thing, name, globs={"np": np, "tribo": tribo}):
        assert not any(doctest.SKIP in example.options for example in test.examples)
        runner.run(test)
    assert runner.summarize(verbose=False).failed == 0
