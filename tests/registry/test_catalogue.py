"""What is installed, as lists and descriptions."""

from __future__ import annotations

from pathlib import Path

import pytest
from fake_distributions import distribute, observer, sources

from tribo.core.errors import CaseError
from tribo.registry.catalogue import catalogue, find
from tribo.registry.registry import Registry


@pytest.fixture
def registry(folder: Path) -> Registry:
    """Two plugins that both claim ``cat.calm``, and one that cannot be used."""
    for name in ("cat_a", "cat_b"):
        code = observer("cat.calm") + observer(f"{name}.own").replace("[Own]", "[Calm, Own]")
        points = {"tribo.v1.observer": {"cat.calm": name, f"{name}.own": name}}
        distribute(folder, name, "1.0", points, **{name: code})
    distribute(folder, "cat_c", "1.0", {"tribo.v2.observer": {"cat.new": "cat_c"}})
    return Registry(sources("cat_a", "cat_b", "cat_c"))


def test_a_name_in_conflict_has_a_row_for_each_claim(registry: Registry) -> None:
    rows = {(row["name"], row["distribution"]): row for row in catalogue(registry)}
    assert {key: row["status"] for key, row in rows.items()} == {
        ("cat_a.own", "cat_a"): "available",
        ("cat_b.own", "cat_b"): "available",
        ("cat.calm", "cat_a"): "conflict",
        ("cat.calm", "cat_b"): "conflict",
        ("", "cat_c"): "incompatible",
    }
    for distribution in ("cat_a", "cat_b"):
        reason = rows["cat.calm", distribution]["reason"]
        assert "offered by cat_a 1.0 and cat_b 1.0" in reason
        assert "disable one of them" in reason


def test_the_summary_of_what_is_not_imported_is_that_of_all(registry: Registry) -> None:
    assert registry.summary("observer", "cat_a.own") == "(all of cat_a) A cat_a for tests."


def test_who_asks_for_a_name_in_conflict_is_told_of_both(registry: Registry) -> None:
    assert find(registry, "cat.calm") == [("observer", "cat.calm")]
    with pytest.raises(CaseError, match=r"offered by cat_a 1\.0 and cat_b 1\.0, so .*disable one"):
        registry.record(*find(registry, "cat.calm")[0])


def test_of_a_distribution_what_is_usable_comes_first(registry: Registry) -> None:
    assert find(registry, "cat_b") == [("observer", "cat_b.own"), ("observer", "cat.calm")]


@pytest.mark.parametrize("name", ["cat_c", "cat.new"])
def test_who_asks_for_what_cannot_be_used_is_told_why(registry: Registry, name: str) -> None:
    with pytest.raises(
        CaseError, match=r"cat_c 1\.0 is incompatible: made for interface version 2"
    ):
        find(registry, name)
