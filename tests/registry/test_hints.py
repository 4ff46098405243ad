"""A distribution that requires tribo but declares no plugin is hinted at."""

from __future__ import annotations

from pathlib import Path

import pytest
from fake_distributions import distribute

from tribo.registry.plugins import undeclared


@pytest.mark.parametrize(
    ("requires", "group", "hinted"),
    [
        ("tribo", "tribo.wear_law", True),
        ("Tribo >=0.1,<2", "other", True),
        ("tribo[x]; python_version>'3'", "other", True),
        ("tribo", "tribo", False),
        ("tribo-energy", "other", False),
        ("tribo; extra == 'test'", "other", False),
        ("tribo ?? 3", "other", False),
    ],
)
def test_what_requires_tribo_and_declares_nothing_is_hinted_at(
    folder: Path, requires: str, group: str, hinted: bool
) -> None:
    distribute(folder, "hinted", "1.2", {"hinted.calm": "hinted"}, ["numpy", requires], group)
    found = [hint for hint in undeclared() if hint.startswith("hinted 1.2 requires tribo")]
    assert len(found) == hinted
