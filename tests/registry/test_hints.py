"""A distribution that may be meant as a plugin, but declares none, is told of."""

from __future__ import annotations

from pathlib import Path

import pytest
from fake_distributions import distribute

from tribo.registry.plugins import undeclared


def hints(folder: Path, requires: str, group: str) -> list[str]:
    points = {"hinted.calm": "hinted"}
    distribute(folder, "hinted", "1.2", points, ["numpy", requires], group)
    return [hint for hint in undeclared() if hint.startswith("hinted ")]


@pytest.mark.parametrize(
    "requires", ["tribo", "tribo<2,>=1", "Tribo >=0.1", "tribo[x]; python_version>'3'"]
)
def test_what_requires_tribo_and_declares_nothing_is_hinted_at(folder: Path, requires: str) -> None:
    (hint,) = hints(folder, requires, "tribo.wear_law")
    assert hint.startswith("hinted 1.2 requires tribo but declares no plugin; if it is one, add ")
    assert "group 'tribo'" in hint


@pytest.mark.parametrize(
    ("requires", "group"),
    [
        ("tribo", "tribo"),
        ("tribo-energy", "other"),
        ("tribo; extra == 'test'", "other"),
        ("tribo ?? 3", "other"),
    ],
)
def test_what_declares_or_does_not_need_tribo_is_not(
    folder: Path, requires: str, group: str
) -> None:
    assert hints(folder, requires, group) == []
