import importlib
from pathlib import Path

import pytest


@pytest.fixture
def dummies(monkeypatch):
    """The module `dummies_in_tables`, importable by name as pickling needs it."""
    monkeypatch.syspath_prepend(Path(__file__).parent)
    return importlib.import_module("dummies_in_tables")
