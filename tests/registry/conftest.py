from __future__ import annotations

from pathlib import Path

import pytest


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of distributions that are found as if installed."""
    monkeypatch.syspath_prepend(str(tmp_path))
    return tmp_path
