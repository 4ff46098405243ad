"""What is installed, as lists and descriptions."""

from typing import Annotated

import pytest
from fake_distributions import distribute, observer, plugins
from pydantic import Field

from tribo import CaseError, Observer, Quantity, Registry
from tribo.registry.catalogue import catalogue, describe, matching
from tribo.registry.plugins import given


def test_components_are_listed_and_found_by_name_or_distribution(folder):
    code = observer("cat.calm") + observer("cat.wild").replace("[Wild]", "[Calm, Wild]")
    points = {"cat.calm": "cat_a", "cat.wild": "cat_a"}
    distribute(folder, "cat_a", "1.0", points, cat_a=code)
    distribute(folder, "cat_c", "1.0", {"new": "cat_c"})
    registry = Registry(plugins("cat_a", "cat_c"))
    rows = {(row["name"], row["distribution"]): row["status"] for row in catalogue(registry)}
    listed = dict.fromkeys([("cat.calm", "cat_a"), ("cat.wild", "cat_a")], "available")
    assert rows == {**listed, ("", "cat_c"): "broken"}
    assert matching(registry, "cat.calm") == ["cat.calm"]
    assert matching(registry, "cat_a") == ["cat.calm", "cat.wild"]
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
