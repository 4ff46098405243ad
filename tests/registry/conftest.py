import os
import sys
from unittest.mock import patch

import pytest
from command_line import tribo

from tribo.cli.commands import offered
from tribo.registry.registry import default_registry
from tribo.result import provenance

CACHES = (default_registry, offered, provenance._code, provenance._installed)
CACHES += (provenance._named_modules, provenance._packages)


def forget(folder):
    """Forget what was imported from a folder and what is installed, as a new process has to."""
    for cached in CACHES:
        cached.cache_clear()
    for name, module in list(sys.modules.items()):
        if str(getattr(module, "__file__", None) or "").startswith(str(folder)):
            del sys.modules[name]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder of distributions that are found as if installed; none stays imported."""
    monkeypatch.syspath_prepend(str(tmp_path))
    forget(tmp_path)
    with patch.dict(os.environ):
        yield tmp_path
    forget(tmp_path)


@pytest.fixture
def asked(folder):
    """A function that runs a command in the folder, with the plugins that are there by then."""

    def ask(*words):
        forget(folder)
        return tribo(*words, cwd=folder)

    return ask
