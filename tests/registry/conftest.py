import os
import sys
from unittest.mock import patch

import pytest

from tribo.registry.registry import default_registry


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder of distributions that are found as if installed; none stays imported."""
    monkeypatch.syspath_prepend(str(tmp_path))
    default_registry.cache_clear()
    # A busy machine makes no plugin that is tried not ready.
    with patch.dict(os.environ, {"TRIBO_PLUGIN_TIME_LIMIT": "240"}):
        yield tmp_path
    default_registry.cache_clear()
    for name, module in list(sys.modules.items()):
        if str(getattr(module, "__file__", None) or "").startswith(str(tmp_path)):
            del sys.modules[name]
