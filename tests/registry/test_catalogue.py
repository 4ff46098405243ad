"""What is installed, as lists and descriptions."""

from typing import Annotated

import pytest
from fake_distributions import distribute, observer, plugins
from pydantic import Field

from tribo import CaseError, Observer, Quantity, Registry
from tribo.registry.catalogue import catalogue, describe, matching
from tribo.registry.plugins import given


@pytest.fixture
def registry(folder):
    """Two plugins that both claim ``cat.calm``, and one that cannot be used."""
    for name in ("cat_a", "cat_b"):
        code = observer("cat.calm") + observer(f"{name}.own").replace("[Own]", "[Calm, Own]")
        points = {"cat.calm": name, f"{name}.own": name}
        distribute(folder, name, "1.0", points, **{name: code})
    distribute(folder, "cat_c", "1.0", {"new": "cat_c"})
    return Registry(plugins("cat_a", "cat_b", "cat_c"))


def test_each_claim_on_a_name_has_a_row(registry):
    rows = {(row["name"], row["distribution"]): row for row in catalogue(registry)}
    assert {key: row["status"] for key, row in rows.items()} == {
        ("cat_a.own", "cat_a"): "available",
        ("cat_b.own", "cat_b"): "available",
        ("cat.calm", "cat_a"): "conflict",
        ("cat.calm", "cat_b"): "conflict",
        ("", "cat_c"): "broken",
    }
    assert "offered by cat_a 1.0 and cat_b" in rows["cat.calm", "cat_a"]["reason"]


def test_components_are_found_by_name_or_distribution(registry):
    assert matching(registry, "cat.calm") == ["cat.calm"]
    assert matching(registry, "cat_b") == ["cat_b.own", "cat.calm"]
    for name in ("cat_c", "new"):
        with pytest.raises(CaseError, match=r"cat_c 1\.0 is broken: 'new' needs a prefix"):
            matching(registry, name)
    with pytest.raises(CaseError, match=r"'cat.clam'; did you mean 'cat.calm'\?"):
        matching(registry, "cat.clam")


class Sensor(Observer):
    type = "cat.sensor"
    names: list[str] = Field(default_factory=list)
    """What to call them."""
    depth: Annotated[float, Quantity("m")]
    """How deep."""


def test_a_description_has_keys_and_units_and_says_where_the_code_is():
    described = describe(Sensor, given(Sensor))
    assert "names (optional): What to call them.\ndepth [m] (needed): How deep.\n" in described
    assert described.endswith(f"File: {__file__}")
