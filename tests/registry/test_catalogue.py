"""What is installed, as lists and descriptions."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import pytest
from fake_distributions import distribute, observer, plugins
from pydantic import BaseModel, ConfigDict, Field

from tribo.core.errors import CaseError
from tribo.core.units import Quantity
from tribo.observers.observer import Observer
from tribo.registry.catalogue import catalogue, describe, find
from tribo.registry.plugins import given
from tribo.registry.registry import Registry


@pytest.fixture
def registry(folder: Path) -> Registry:
    """Two plugins that both claim ``cat.calm``, and one that cannot be used."""
    for name in ("cat_a", "cat_b"):
        code = observer("cat.calm") + observer(f"{name}.own").replace("[Own]", "[Calm, Own]")
        points = {"cat.calm": name, f"{name}.own": name}
        distribute(folder, name, "1.0", points, **{name: code})
    distribute(folder, "cat_c", "1.0", {"new": "cat_c"})
    return Registry(plugins("cat_a", "cat_b", "cat_c"))


def test_a_name_in_conflict_has_a_row_for_each_claim(registry: Registry) -> None:
    rows = {(row["name"], row["distribution"]): row for row in catalogue(registry)}
    assert {key: row["status"] for key, row in rows.items()} == {
        ("cat_a.own", "cat_a"): "available",
        ("cat_b.own", "cat_b"): "available",
        ("cat.calm", "cat_a"): "conflict",
        ("cat.calm", "cat_b"): "conflict",
        ("", "cat_c"): "broken",
    }
    for distribution in ("cat_a", "cat_b"):
        assert "offered by cat_a 1.0 and cat_b" in rows["cat.calm", distribution]["reason"]
    # Of what is not imported, only the summary of its distribution is known.
    assert rows["cat_a.own", "cat_a"]["summary"] == "(all of cat_a) A cat_a for tests."


def test_a_name_in_conflict_is_found_and_comes_last_of_its_distribution(registry: Registry) -> None:
    assert find(registry, "cat.calm") == ["cat.calm"]
    assert find(registry, "cat_b") == ["cat_b.own", "cat.calm"]


@pytest.mark.parametrize("name", ["cat_c", "new"])
def test_who_asks_for_what_cannot_be_used_is_told_why(registry: Registry, name: str) -> None:
    with pytest.raises(CaseError, match=r"cat_c 1\.0 is broken: 'new' needs a prefix"):
        find(registry, name)


class Place(BaseModel):
    model_config = ConfigDict(use_attribute_docstrings=True)

    depth: Annotated[float, Quantity("m")]
    """How deep."""
    below: Place | None = None
    """The next one."""


class Sensor(Observer):
    type = "cat.sensor"
    names: list[str] = Field(default_factory=list)
    """What to call them."""
    places: dict[str, Place] | None = None
    """Where they sit."""


def test_a_description_has_keys_and_units_of_nested_tables_and_says_where_the_code_is() -> None:
    lines = describe(Sensor, given(Sensor)).splitlines()
    first = lines.index("names (optional): What to call them.")
    assert lines[first : first + 4] == [
        "names (optional): What to call them.",
        "places (optional): Where they sit.",
        "    depth [m] (needed): How deep.",
        "    below (optional): The next one.",
    ]
    assert lines[-1] == f"File: {__file__}"


@pytest.mark.parametrize("text", [None, 7, "", b"bytes"])
def test_a_docstring_that_is_no_text_is_none(monkeypatch: pytest.MonkeyPatch, text: object) -> None:
    monkeypatch.setattr(Sensor, "__doc__", text)
    assert "(it has no description)" in describe(Sensor, given(Sensor))
