"""Laws made of another: a factor, running-in by work and by roughness."""

import pytest
from paper_models import pin

from tribo import Archard, CaseError, Field, ModifiedLaw, Registry, Simulation, WearRate, hookimpl
from tribo.config.load import case_tables
from tribo.core.material import Material
from tribo.wear.modified import Scaled
from tribo.wear.running_in import RunningIn, Smoothing

STEEL = Material(young="207 GPa", poisson=0.3)
K = 1e-15
ARCHARD = Archard(k=K)


def test_a_surface_smoother_than_it_settles_at_is_refused():
    with pytest.raises(CaseError, match="settled must be less than roughness"):
        Smoothing(law=ARCHARD, factor=2, roughness="0.1 um", settled="0.1 um", depth="1 um")


class Tired(ModifiedLaw):
    """A stranger's: wear halves where the surface is oxidised, and grows with each metre."""

    type = "stranger.tired"
    own_requires = ("friction_coefficient", "stranger_oxide")
    own_state = (Field("slid", "m", "Distance slid."),)

    def rate(self, local):
        rate = self.law.rate(local)
        more = 1 + local.state["slid"]
        slid = {"slid": (local.pressure > 0).astype(float)}
        return WearRate(more * rate.depth_rate, more * rate.depth_slope, rate.state_rates | slid)


class Fussy(Archard):
    """A law that refuses materials and cells."""

    type = "stranger.fussy"

    def check(self, material):
        raise CaseError("no such material")

    def check_cells(self, spacing):
        raise CaseError("no such cells")


def test_it_needs_keeps_and_refuses_what_either_does():
    inner = RunningIn(law=Tired(law=ARCHARD), factor=2, over=1e9)
    law = Scaled(law=inner, factor=0.5)
    assert law.requires == ("friction_coefficient", "stranger_oxide")
    assert [field.name for field in law.state_fields] == ["slid", "pressure_distance"]
    assert law.initial_state() == {"slid": 0.0, "pressure_distance": 0.0}
    fussy = Scaled(law=Fussy(k=K), factor=1)
    with pytest.raises(CaseError, match="no such material"):
        fussy.check(STEEL)
    with pytest.raises(CaseError, match="no such cells"):
        fussy.check_cells((1e-6, 1e-6))


def test_two_laws_that_keep_the_same_field_are_refused():
    twice = {"type": "running_in", "factor": 2, "over": 1e9}
    with pytest.raises(ValueError, match="'pressure_distance' is declared twice"):
        RunningIn.model_validate({**twice, "law": {**twice, "law": ARCHARD}})


class Offered:
    @staticmethod
    @hookimpl
    def tribo_components():
        return [Tired]


def case(law):
    tables = case_tables(pin().case)
    tables["bodies"]["pin"]["wear"] = law
    return tables


def test_what_is_wrong_inside_is_told_with_its_place():
    wrong = {"type": "scaled", "factor": 2, "law": {"type": "archard", "k": "1e-15 m"}}
    with pytest.raises(CaseError, match=r"^bodies\.pin\.wear\.law\.k: "):
        Simulation(case(wrong))
    with pytest.raises(CaseError, match=r"^bodies\.pin\.wear\.law\.type: .*'archad'"):
        Simulation(case({**wrong, "law": {"type": "archad"}}))
    tired = {"type": "scaled", "factor": 2, "law": {"type": "stranger.tired", "law": ARCHARD}}
    with pytest.raises(CaseError, match=r"pin\.wear: .* needs friction_.*stranger_oxide"):
        Simulation(case(tired), registry=Registry.with_plugins(Offered))


def test_the_law_inside_is_named_in_the_result():
    with Simulation(case(Scaled(factor=0.25, law=ARCHARD))).run() as result:
        inner = result.provenance["components"]["bodies.pin.wear.law"]
    assert (inner["type"], inner["distribution"]) == ("archard", "tribo")
