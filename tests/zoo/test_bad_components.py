"""Faulty components end a case that names them with one message, and harm no other."""

import numpy as np
import pytest
from zoo.components import ZOO, Ball, Heat, Law, Watcher, raising
from zoo.motions import Slide
from zoo_keeper import Zoo, case_of, expect_harmless, expect_one_message

from tribo import CaseError, DcFft, Result, Simulation


@pytest.mark.filterwarnings("ignore:invalid value:RuntimeWarning")
@ZOO.each
def test_it_ends_with_one_message(run, bad):
    expect_one_message(run(ZOO, bad.cls, **bad.case), bad)


CONFIGURED = [bad for bad in ZOO.kept if bad.code == 2]


@pytest.mark.parametrize("bad", CONFIGURED, ids=lambda bad: bad.cls.__name__)
def test_a_check_ends_with_it_too(tmp_path, command, bad):
    (tmp_path / "case.toml").write_text(case_of(bad.cls))
    expect_one_message(command(ZOO, "check", "case.toml"), bad)


def test_none_harms_a_case_that_names_another(run):
    expect_harmless(run(ZOO))


def test_the_last_good_state_is_kept(run):
    zoo = Zoo()
    cls = zoo.bad("tires", Law, spoilt=lambda self, good, local: good if self._calls < 26 else None)
    assert run(zoo, cls).returncode == 3
    with Result.open("case.h5") as result:
        last = result.saves()[-1]
    assert 0 < last["distance_m"] < 2
    volume = last["bodies"]["ball"]["wear_volume_m3"]
    assert volume == pytest.approx(3e-16 * 100 * last["distance_m"], rel=1e-10, abs=0)


@pytest.mark.parametrize(
    ("base", "method", "place"),
    [
        (Ball, "height", "bodies.ball.surface"),
        (Heat, "check", "effects"),
        (Slide, "exposures", "kinematics"),
    ],
)
def test_what_a_component_refuses_is_bad_input_at_its_place(run, base, method, place):
    zoo = Zoo()
    cls = zoo.bad("refuses", base, **{method: raising(CaseError("this is too small"))})
    ended = run(zoo, cls)
    assert ended.returncode == 2
    assert ended.stderr.startswith(f"error: {place}: this is too small")


# Observers have no say in the answer.


def forgetting_the_bodies(self, snapshot):
    snapshot.state.bodies.clear()
    for of_bodies in snapshot.state.rates:
        of_bodies.clear()
    snapshot.measures.bodies.clear()


def forgetting_the_case(self, run):
    run.case.clear()
    run.provenance.clear()
    run.system.materials.clear()
    run.bodies[0].height[:] = 0


@pytest.mark.slow
def test_what_an_observer_does_to_its_own_view_changes_no_bit(tmp_path):
    zoo, results = Zoo(), []
    meddler = zoo.bad(
        "forgets", Watcher, on_start=forgetting_the_case, on_step=forgetting_the_bodies
    )
    for name, classes in (("plain", ()), ("watched", (meddler,))):
        case = tmp_path / f"{name}.toml"
        case.write_text(case_of(*classes))
        results.append(Simulation(case, zoo.registry()).run(case.with_suffix(".h5")))
    plain, watched = results
    assert plain.totals()["steps"] == watched.totals()["steps"]
    np.testing.assert_array_equal(plain.field("pressure", -1), watched.field("pressure", -1))
    worn = [result.body("ball").wear_depth[-1] for result in results]
    np.testing.assert_array_equal(*worn)
    assert len(watched.case_tables["observers"]) == 1


LAST_WORDS = "observer 'zoo.ends_badly' raised ValueError: cannot say goodbye"


def ending_badly(zoo):
    return zoo.bad("ends_badly", Watcher, on_finish=raising(ValueError("cannot say goodbye")))


def test_what_fails_at_the_end_costs_no_result(run):
    zoo = Zoo()
    ended = run(zoo, ending_badly(zoo))
    assert ended.returncode == 3
    (line,) = ended.stderr.splitlines()
    assert line.startswith(f"error: {LAST_WORDS}")
    with Result.open("case.h5") as result:
        assert result.status == "done"


def test_of_a_run_that_failed_already_the_first_cause_is_the_error(run):
    def failing(self, problem, start=None):
        return None if start is not None else DcFft.solve(self, problem)

    zoo = Zoo()
    ended = run(zoo, ending_badly(zoo), zoo.bad("fails", DcFft, solve=failing))
    assert ended.returncode == 3
    later, first, _ = ended.stderr.splitlines()
    assert later.startswith(f"warning: {LAST_WORDS}")
    assert first.startswith("error: contact solver 'zoo.fails' gave a NoneType")
    with Result.open("case.h5") as result:
        assert result.status == "failed"
        assert "zoo.fails'" in result.warnings[-1]
