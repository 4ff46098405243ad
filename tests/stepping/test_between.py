"""State of effects: where it lies, its limits, rests, and that it goes on after a stop."""

from collections.abc import Mapping

import numpy as np
import pytest
from paper_models import K, archard, foundation, goes_on, motion, pair, pin, small, states
from strangers.debris import Covered, Debris

from tribo import CaseError, Effect, Field, Grid, RunningIn, Simulation, WearLaw, WearRate
from tribo.core.errors import PluginError
from tribo.core.fields import LOAD_SHARE
from tribo.stepping.explicit import Explicit
from tribo.stepping.implicit import Implicit

COVERED = Covered(k=K, cover="50 nm")
WARM = Field("warm", "K", "Temperature of a bath.", uniform=True, at_least=0)


class Bath(Effect):
    """dT/dt = h v − (T − 300 K)/τ."""

    type = "test.bath"
    time: float = 20.0
    begin: float = 300.0
    heats: float = 100.0

    state_fields = (WARM,)

    def initial_state(self):
        return {"warm": self.begin}

    def state_rates(self, contact):
        return {"warm": self.heats * contact.speed - (contact.state["warm"] - 300.0) / self.time}


def model(law=COVERED, effects=(), **changes):
    bodies = pair(law, law)
    return small(
        **{
            "grid": Grid((0.7e-3, 0.7e-3), (20, 20)),
            "bodies": bodies,
            "contact": foundation(),
            "kinematics": motion(duration=4),
            "effects": effects,
            **changes,
        }
    )


@pytest.mark.parametrize("stepping", [Implicit(), Explicit(time_step="0.2 s")])
def test_both_schemes_come_to_the_same_in_few_solves(stepping):
    last = states(model(effects=[Debris(length="0.5 m")], stepping=stepping))[-1]
    middle = last.between["debris_thickness"][10, 10]
    assert middle == pytest.approx(1.0052e-7, rel=5e-3, abs=0)
    # Without the slopes through states implicit steps take 37.
    assert last.contact_solves <= 26


def test_on_a_body_that_passes_it_moves_with_it():
    case = model(
        effects=[Debris(length="2 mm", on="disk")],
        kinematics=motion(stroke="0.5 mm", frequency=5, duration=3, positions=9),
    )
    last = states(case)[-1]
    wear, debris = last.bodies["disk"].wear, last.remembered("disk", "debris_thickness")
    assert debris.shape == wear.shape
    assert len(wear) > 20
    # It mirrors itself about mid-stroke, as the stroke does.
    np.testing.assert_allclose(debris, debris[::-1], rtol=1e-6, atol=1e-13)
    assert np.count_nonzero(debris) == np.count_nonzero(wear)


class Film(Debris):
    """Debris of which a body has some from the beginning."""

    type = "test.film"
    begins: float

    def initial_state(self):
        return {"debris_thickness": self.begins}


ON_EACH = [Film(length=1e9, on=on, begins=begins) for on, begins in (("ball", 0), ("disk", 5e-8))]


@pytest.mark.slow
def test_a_resumed_run_has_the_same_bits(tmp_path):
    short = motion(duration=0.3)
    case = model(effects=[*ON_EACH, Bath()], kinematics=short, save_times=(0.2,)).case
    goes_on(case, tmp_path, 3).close()


def test_a_law_follows_the_film_on_its_own_body_where_each_has_one():
    short = motion(duration=0.1)
    films = [film.model_copy(update={"caught": 0.0}) for film in ON_EACH]
    filmed = states(model(effects=films, kinematics=short))[-1]
    bare = states(model(kinematics=short, bodies=pair(archard(), archard(K / np.e))))[-1]
    for name, body in bare.bodies.items():
        np.testing.assert_allclose(filmed.bodies[name].wear, body.wear, rtol=1e-9)


class Twice(Bath):
    type = "test.twice"


@pytest.mark.parametrize(
    ("effects", "words"),
    [
        ([Debris(length=1, on="pin")], "lies on 'pin'; the bodies are ball, disk"),
        ([Bath(), Twice()], "'warm' is provided twice"),
        ([Debris(length=1, on="disk")] * 2, "'debris_thickness' is provided twice"),
        ([Debris(length=1), *ON_EACH[:1]], "'debris_thickness' is provided twice"),
        ([*ON_EACH[:1], Debris(length=1)], "'debris_thickness' is provided twice"),
        ([Bath(begin=-1)], "'initial warm' that is -1"),
    ],
)
def test_a_state_that_cannot_be_is_refused(effects, words):
    with pytest.raises((CaseError, PluginError), match=words):
        model(archard(), effects=effects)


class Follows(Effect):
    """Reads what a law remembers."""

    type = "test.follows"
    requires = ("rubbed",)
    provides = (Field("rubbed_twice", "m", "Twice that."),)

    def fields(self, contact) -> Mapping:
        both = contact.fields["rubbed"]
        assert set(both) == {"ball"}
        return {"rubbed_twice": dict.fromkeys(contact.materials, 2 * both["ball"])}


class Rubbed(WearLaw):
    type = "test.rubbed"
    state_fields = (Field("rubbed", "m", "Slid."),)

    def rate(self, local):
        k = np.full_like(local.pressure, K)
        return WearRate(k * local.pressure, k, {"rubbed": np.where(local.pressure > 0, 1.0, 0.0)})


def test_an_effect_may_require_what_a_law_remembers():
    bodies = pair(Rubbed(), archard())
    with Simulation(model(bodies=bodies, effects=[Follows()])).run() as result:
        twice = result.body("disk").effects["rubbed_twice"][-1]
        assert twice.max() == pytest.approx(2 * result.distances[-1])


class OfBoth(Follows):
    type = "test.of_both"

    def fields(self, contact):
        both = contact.fields["rubbed"]
        return {"rubbed_twice": {name: 2 * both[name] for name in contact.materials}}


def test_a_body_whose_law_does_not_remember_is_named():
    bodies = pair(Rubbed())
    words = r"^bodies\.disk\.wear: an effect needs the state 'rubbed' of 'disk'.*of ball has it"
    with pytest.raises(CaseError, match=words):
        states(model(bodies=bodies, effects=[OfBoth()]))


class Fades(Effect):
    """Carries the part s / m of the load, and may keep a state that nothing follows."""

    type = "test.fades"
    keeps: bool = True
    provides = (LOAD_SHARE,)

    @property
    def state_fields(self):
        return (Field("clock", "m", "Distance slid."),) if self.keeps else ()

    def initial_state(self):
        return {"clock": 0.0} if self.keeps else {}

    def fields(self, contact):
        carried = np.full((1, 1), min(contact.distance, 1.0))
        return {LOAD_SHARE.name: dict.fromkeys(contact.materials, carried)}

    def state_rates(self, contact):
        return {"clock": np.full((1, 1), contact.speed)} if self.keeps else {}


@pytest.mark.parametrize("law", [archard(), RunningIn(law=archard(), factor=1, over=1e7)])
@pytest.mark.parametrize("keeps", [False, True])
def test_what_follows_the_distance_is_taken_along_the_step(keeps, law):
    last = states(pin(law, effects=[Fades(keeps=keeps)]))[-1]
    assert np.max(last.bodies["pin"].wear) == pytest.approx(0.5 * K * 10e6, rel=6e-3, abs=0)
