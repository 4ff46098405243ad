"""What models need of materials, by name and unit."""

from typing import Annotated

import pytest
from paper_models import K, archard, case, foundation, motion

from tribo import CaseError, Field, Grid, Quantity, Scaled, Simulation, WearLaw, WearRate
from tribo.config.load import case_tables, validate_case
from tribo.testing.kit import names_of, outcome_of, suites

STRENGTH = Field("strength", "Pa", "What it bears.", at_least=1e6, typical=2e9)


class Brittle(WearLaw):
    """dh/ds = K p/σ, with σ the strength of the material."""

    type = "test.brittle"
    K: Annotated[float, Quantity("1", at_least=0)] = 1e-6
    """Archard's dimensionless coefficient."""
    material_properties = (STRENGTH,)

    def rate(self, local):
        k = self.K / local.material.property("strength")
        return WearRate(k * local.pressure, k)


class Silent(Brittle):
    """It does not declare what it reads."""

    type = "test.silent"
    material_properties = ()


class Deaf(Brittle):
    """It declares a property that it does not read."""

    type = "test.deaf"
    material_properties = (STRENGTH, Field("toughness", "Pa", "Of no use.", typical=1e6))


class Dense(WearLaw):
    """It needs a property that has a key of its own."""

    type = "test.dense"
    material_properties = (Field("density", "kg/m^3", "Density."),)

    def rate(self, local):
        k = 1e-20 * local.material.property("density")
        return WearRate(k * local.pressure, k)


def tables(law, *, ball=None, disk=None):
    """The tables of a small case, with further properties of each body."""
    window = {"grid": Grid((0.7e-3, 0.7e-3), (20, 20)), "contact": foundation()}
    found = case_tables(case(**window, kinematics=motion(duration=0.1)))
    found["bodies"]["ball"]["wear"] = law
    for name, properties in (("ball", ball), ("disk", disk)):
        found["bodies"][name]["material"]["properties"] = properties
    return found


def worn(law, **properties):
    with Simulation(tables(law, **properties)).run() as result:
        return result.saves()[-1]["bodies"]["ball"]["wear_volume_m3"], result.case_tables


@pytest.mark.parametrize(
    ("law", "disk"),
    [
        (Brittle(K=K * 2e9), None),
        (Scaled(law=Brittle(K=K * 1e9), factor=2.0), {"strength": "9 GPa"}),
    ],
)
def test_a_law_reads_it_of_its_own_body_in_si(law, disk):
    volume, stored = worn(law, ball={"strength": "2 GPa"}, disk=disk)
    assert volume == pytest.approx(worn(archard())[0], rel=1e-12, abs=0)
    assert stored["bodies"]["ball"]["material"]["properties"] == {"strength": 2e9}


@pytest.mark.parametrize(
    ("law", "properties", "place", "words"),
    [
        (Brittle(), {}, "ball.material.properties.strength", r"'test\.brittle' .* 'ball': .*Pa"),
        (Brittle(), {"ball": {"strength": "2 mm"}}, "ball.material.properties.strength", "length"),
        (Brittle(), {"ball": {"strength": 2}}, "ball.material.properties.strength", "2 Pa: .*MPa"),
        (Brittle(), {"disk": {"strengt": 2}}, "disk.material.properties.strengt", "'strength'"),
        (archard(), {"disk": {"strength": 2e9}}, "disk.material.properties.strength", "no model"),
        (Dense(), {}, "ball.material.density", r"'test\.dense' .*kg/m\^3"),
    ],
    ids=["missing", "unit", "limit", "misspelt", "unknown", "key"],
)
def test_what_is_wrong_with_it_is_told_at_its_place(law, properties, place, words):
    with pytest.raises(CaseError, match=rf"(?m)bodies\.{place}: .*{words}"):
        validate_case(tables(law, **properties))


@pytest.mark.parametrize(
    ("law", "failed"),
    [(Brittle, set()), (Deaf, {"what_is_declared_matters"}), (Silent, {"answers_fit_a_run"})],
)
def test_the_kit_gives_what_is_declared_and_finds_what_is_not_read_or_not_declared(law, failed):
    (checks,) = suites(law, [{}])
    outcomes = [outcome_of(checks, name) for name in failed or names_of(type(checks))]
    assert {each.check for each in outcomes if each.status == "failed"} == failed
