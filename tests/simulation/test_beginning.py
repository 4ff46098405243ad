"""A run that begins with the worn bodies of a result."""

import numpy as np
import pytest
from edited import bits, edited
from paper_models import (
    K,
    StopAfter,
    archard,
    case,
    flat,
    foundation,
    half_space,
    motion,
    named,
    pair,
    paraboloid,
    sphere,
    steel,
)

from tribo import (
    CaseError,
    Effect,
    Field,
    Grid,
    Interrupted,
    Scaled,
    Simulation,
    Stop,
    WearLaw,
    WearRate,
)
from tribo.plotting.pressure import pressure_map
from tribo.simulation.beginning import first_state
from tribo.simulation.predict import predict
from tribo.study.runs import is_done

GRID = Grid((0.7e-3, 0.7e-3), (32, 32))
SPEED = 0.1


def worn_case(duration=10, **changes):
    parts = {"grid": GRID, "contact": foundation(), "kinematics": motion(duration=duration)}
    return case(**{**parts, **changes})


@pytest.fixture(scope="module")
def run_in(tmp_path_factory):
    """Ten seconds under 20 N, saved after four as well."""
    path = tmp_path_factory.mktemp("run_in") / "run_in.h5"
    Simulation(worn_case(load=20.0, save_times=(4,))).run(path).close()
    return path


class Slips(WearLaw):
    """Wears less the further a point has slid."""

    type = "test.slips"
    state_fields = (Field("slip", "m", "How far this point has slid under pressure."),)

    def rate(self, local):
        k = K / (1 + local.state["slip"])
        return WearRate(k * local.pressure, k, {"slip": np.where(local.pressure > 0, 1.0, 0.0)})


@pytest.mark.slow
def test_what_has_worn_yielded_and_is_remembered_along_a_resolved_track_goes_on(tmp_path):
    bodies = pair(archard(), Slips(), hardness=(None, 1.2e9))
    kinematics = motion(stroke=24 * GRID.spacing[0], duration=0.2, positions=9)
    parts = {"bodies": bodies, "contact": half_space(), "kinematics": kinematics}
    begin = tmp_path / "first.h5"
    along = ("track_plastic", "track_state_slip", "track_depth")
    with Simulation(worn_case(**parts)).run(begin) as first:
        before = {name: first.field(name, -1, "disk") for name in along}
        for name, window in zip(along, ("plastic_depth", "slip", "wear_depth"), strict=True):
            np.testing.assert_array_equal(before[name][12:-12], first.field(window, -1, "disk"))
            assert np.all(np.isnan(first.field(name, -1, "ball")))
    # The ends of the stroke have yielded beyond the window.
    assert before["track_plastic"][:12].max() > 0.1 * before["track_plastic"].max() > 1e-9
    with Simulation(worn_case(begin=begin, **parts)).run() as second:
        for name in along[1:]:
            np.testing.assert_array_equal(second.field(name, 0, "disk"), before[name])
        for save, more in ((0, 1e-6), (-1, 1e-3)):
            # As it slides on it wears, and the edges of the groove yield a little more.
            found, was = second.field(along[0], save, "disk"), before[along[0]]
            np.testing.assert_allclose(found, was, atol=more * was.max(), rtol=0)


def test_what_a_law_within_a_law_remembers_goes_on(tmp_path):
    begin, small = tmp_path / "first.h5", {"grid": Grid((0.7e-3, 0.7e-3), (24, 24))}
    with Simulation(worn_case(duration=1, bodies=pair(Slips()), **small)).run(begin) as first:
        slipped = first.field("slip", -1, "ball")
    endings = ["start at 0", "start at 0", "; not taken from it: slip of ball"]
    laws = Slips(), Scaled(factor=0.5, law=Slips()), archard()
    for law, ending in zip(laws, endings, strict=True):
        case = worn_case(duration=1, bodies=pair(law), begin=begin, **small)
        state = first_state(Simulation(case).model)
        assert state.findings[-1].words.endswith(ending)
        kept = state.bodies["ball"].law
        assert not kept or np.array_equal(kept["slip"], slipped)


class Warm(Effect):
    """A temperature that grows, in the contact or on the ball, as one number or a field."""

    type = "test.warm"
    unit: str = "K"
    even: bool = False
    on: str | None = None

    @property
    def state_fields(self):
        return (Field("warm", self.unit, "Temperature.", uniform=self.even),)

    def carrier(self):
        return self.on

    def initial_state(self):
        return {"warm": 1.0}

    def state_rates(self, contact):
        return {"warm": np.ones((1, 1))}


def test_what_an_effect_remembers_goes_on_at_its_place_only_and_the_finding_says_so(tmp_path):
    small = {"grid": Grid((0.7e-3, 0.7e-3), (24, 24))}
    field, even, on_ball = Warm(), Warm(even=True), Warm(on="ball")
    pairs = {field: [field, even, on_ball, Warm(unit="1")], even: [even, field]}
    for was, each in pairs.items():
        begin = tmp_path / f"{was.even}.h5"
        Simulation(worn_case(duration=1, effects=[was], **small)).run(begin).close()
        for now in each:
            case = worn_case(duration=1, effects=[now], begin=begin, **small)
            state = first_state(Simulation(case).model)
            text = state.findings[-1].words
            (warm,) = state.between.values()
            np.testing.assert_allclose(warm, 2.0 if now == was else 1.0)
            before, after = (f"warm of {each.on or 'the contact'}" for each in (was, now))
            words = f"start afresh: {after}; not taken from it: {before}"
            assert text.endswith("start at 0" if now == was else words)


@pytest.mark.slow
def test_a_stopped_run_goes_on_to_the_same_bits_without_the_result_it_began_with(tmp_path):
    first = tmp_path / "first.h5"
    Simulation(worn_case(load=20.0, duration=1)).run(first).close()
    simulation = Simulation(worn_case(begin=first, duration=1))
    with simulation.run() as whole:
        with pytest.raises(Interrupted):
            simulation.run(tmp_path / "second.h5", observers=[StopAfter(steps=3)])
        first.unlink()
        with simulation.resume(tmp_path / "second.h5") as resumed:
            assert bits(resumed) == bits(whole)
            assert resumed.provenance["begun_with"] == whole.provenance["begun_with"]
            assert resumed.warnings[0].startswith(f"begin: the bodies begin as worn as in {first}")
            assert len(resumed.provenance["begun_with"]["sha256"]) == 64


def test_a_run_that_began_with_what_is_another_file_by_now_is_neither_taken_nor_resumed(tmp_path):
    first, second = tmp_path / "first.h5", tmp_path / "second.h5"
    Simulation(worn_case(load=20.0, duration=1)).run(first).close()
    simulation = Simulation(worn_case(begin=first, duration=1))
    simulation.run(second).close()
    assert is_done(second, simulation)
    Simulation(worn_case(load=40.0, duration=1)).run(first, overwrite=True).close()
    assert not is_done(second, simulation)
    # As if it had been stopped.
    with edited(second) as file:
        file.attrs["status"] = "interrupted"
    with pytest.raises(CaseError, match=r"begin was a file of .*--allow-changed"):
        simulation.resume(second)


def test_a_depth_that_is_reached_already_ends_the_run_at_once(run_in):
    with Simulation(worn_case(begin=run_in, stop=Stop(depth=1e-9))).run() as result:
        assert (len(result.times), result.status) == (1, "done")
        assert "ended at 0 s, where the wear depth reached 0.001 µm" in "".join(result.warnings)


def test_worn_bodies_are_not_held_against_hertz(run_in):
    model = Simulation(worn_case(duration=1, begin=run_in)).model
    with Simulation(model).run() as result:
        assert result.report().first_contact.hertz_peak_pressure_Pa is None
        assert len(pressure_map(result).figure().legends) == 0
    assert predict(model).hertz is None


PIN = [named("pin", sphere(), steel(), archard()), named("disk", flat(), steel(), archard())]
ROUND = [named("ball", paraboloid(), steel(), archard()), named("disk", flat(), steel(), archard())]


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"grid": Grid((0.7e-3, 0.7e-3), (30, 30))}, "32 × 32 cells .* and the case 30 × 30 cells"),
        ({"bodies": PIN}, "has the bodies ball, disk, and the case pin, disk"),
        ({"bodies": ROUND}, "another surface of ball"),
        ({"kinematics": motion(swept="ball", positions=33)}, "ball moves in .* kinematics.swept"),
        (
            {"kinematics": motion(positions=33)},
            "disk has 32 rows of cells in .*, and 124 in the case",
        ),
    ],
)
def test_a_result_that_does_not_fit_the_case_is_refused(run_in, changes, words):
    with pytest.raises(CaseError, match=rf"begin: .*{words}"):
        Simulation(worn_case(begin=run_in, **changes)).run()


def test_a_file_that_is_not_there_is_refused():
    with pytest.raises(CaseError, match=r"begin: no\.h5 is not a file"):
        Simulation(worn_case(begin="no.h5")).run()
