"""Runs end to end: saves, stops, interruption and resumption."""

import errno
import os
import signal
from unittest.mock import Mock

import numpy as np
import paper_models
import pytest
from edited import bits
from paper_models import archard, motion, named, pair, small, steel

from tribo import CaseError, Cylinder, Grid, Interrupted, NumericalError, Result, Simulation
from tribo.case import Stop
from tribo.core.errors import OutputError, TriboWarning
from tribo.motion.closed_track import Unidirectional
from tribo.observers.observer import Observer
from tribo.result import checkpoint
from tribo.simulation.march import begin, march
from tribo.stepping.explicit import Explicit
from tribo.stepping.implicit import Implicit


def case(**changes):
    return paper_models.case(**{"grid": Grid((0.7e-3, 0.7e-3), (24, 24)), **changes})


class Stopper(Observer):
    """Sends this process a signal after some steps, as Ctrl-C does."""

    after: int
    number: int = signal.SIGINT

    def on_step(self, snapshot):
        if snapshot.state.steps == self.after:
            os.kill(os.getpid(), self.number)


SHORT = {"kinematics": motion(duration=10)}
WATCHED = {"save_times": (4, 20), "kinematics": motion(duration=30)}


@pytest.fixture(scope="module")
def undisturbed():
    with Simulation(case(**WATCHED)).run() as result:
        return bits(result)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("number", "stops"), [(signal.SIGINT, [0]), (signal.SIGTERM, [5, 11])], ids=["once", "twice"]
)
def test_a_stopped_run_resumes_to_the_same_bits(tmp_path, undisturbed, number, stops):
    path = tmp_path / "run.h5"
    go_on = Simulation(case(**WATCHED)).run
    for after in stops:
        with pytest.raises(Interrupted, match="tribo resume"):
            go_on(path, observers=[Stopper(after=after, number=number)])
        with Result.open(path) as result:
            assert result.status == "interrupted"
            assert result.times[-1] < 30
        go_on = Simulation(case(**WATCHED)).resume
    with go_on(path) as result:
        assert result.status == "done"
        assert bits(result) == undisturbed
    assert list(tmp_path.iterdir()) == [path]


def test_a_stop_in_the_last_step_is_not_lost_nor_is_the_result(tmp_path):
    path, simulation = tmp_path / "run.h5", Simulation(case(kinematics=motion(duration=1)))
    *_, last = march(simulation.model, begin(simulation.model))
    with pytest.raises(Interrupted, match="has all of it"):
        simulation.run(path, observers=[Stopper(after=last.state.steps)])
    with Result.open(path) as result:
        assert result.status == "done"


@pytest.mark.slow
def test_only_a_stopped_run_of_the_same_case_is_resumed(tmp_path):
    path = tmp_path / "run.h5"
    with pytest.raises(Interrupted):
        Simulation(case(**SHORT)).run(path, observers=[Stopper(after=3)])
    with pytest.raises(CaseError, match="another case"):
        Simulation(case(load=50.0)).resume(path)
    Simulation(case(**SHORT)).resume(path).close()
    with pytest.raises(CaseError, match="nothing to resume"):
        Simulation(case(**SHORT)).resume(path)


def test_the_checkpoint_of_another_case_is_not_gone_on_with(tmp_path):
    ours, theirs = tmp_path / "ours.h5", tmp_path / "theirs.h5"
    for path, load in ((ours, 100.0), (theirs, 80.0)):
        with pytest.raises(Interrupted):
            Simulation(case(load=load)).run(path, observers=[Stopper(after=5)])
    theirs.replace(ours)
    with pytest.raises(CaseError, match="belongs to another case"):
        Simulation(case(load=80.0)).resume(ours)


def test_an_existing_result_is_replaced_only_when_told(tmp_path):
    path = tmp_path / "run.h5"
    path.write_text("mine")
    with pytest.raises(CaseError, match=r"exists; .*--force"):
        Simulation(case()).run(path)
    assert path.read_text() == "mine"
    Simulation(case(kinematics=motion(duration=1))).run(path, overwrite=True).close()
    assert Result.open(path).status == "done"


def test_a_run_says_that_it_has_not_worn_to_the_depth_at_which_it_is_to_end():
    result = Simulation(case(stop=Stop(depth="300 um"), kinematics=motion(duration=20))).run()
    found, body = result.findings[-1], result.saves()[-1]["bodies"]["ball"]
    assert (found.kind, found.value, found.limit) == ("stop", body["max_wear_depth_m"], 300e-6)


def test_a_contact_that_reaches_the_edge_stops_the_run_with_what_was_saved(tmp_path):
    path = tmp_path / "run.h5"
    model = small(grid=Grid((0.4e-3, 0.4e-3), (32, 32)), save_times=(5,))
    with pytest.raises(NumericalError, match=r"reached the edge .*grid\.size") as failed:
        Simulation(model.case).run(path)
    # Whose window is merely small has forgotten no unit.
    assert "unit" not in str(failed.value)
    with Result.open(path) as result:
        assert result.status == "failed"
        assert list(result.times[:2]) == [0, 5]
        assert np.all(np.isfinite(result.field("pressure", -1)))
        assert result.warnings[-1].startswith("failed: at ")


@pytest.mark.parametrize(
    ("k", "failure"), [(1e-2, "miss their tolerances"), (1e-6, "reached the edge of the window")]
)
@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:wear rate")
def test_a_run_that_fails_asks_for_the_unit_of_a_wear_coefficient_that_is_absurd(k, failure):
    bodies = pair(archard(k=k))
    with pytest.raises(NumericalError, match=failure) as failed:
        Simulation(case(bodies=bodies)).run()
    assert f"bodies.ball.wear.k is {k:g} 1/Pa, usual are" in str(failed.value)
    assert "'1e-6 mm^3/(N m)'" in str(failed.value)


def test_few_cells_are_warned_of_once_and_a_short_stroke_as_the_run_begins_and_ends():
    model = small(
        grid=Grid((0.7e-3, 0.7e-3), (14, 14)), kinematics=motion(stroke="0.6 mm", frequency=50)
    )
    with pytest.warns(TriboWarning) as caught:
        result = Simulation(model.case).run()
    texts = [str(w.message) for w in caught if issubclass(w.category, TriboWarning)]
    assert {each.kind for each in result.findings} == {"resolution", "averaging"}
    begun, few, ended = texts
    assert begun.startswith("averaging: at 0 s")
    assert result.warnings == (few, ended)


def test_a_track_shorter_than_its_contact_and_few_cells_across_alone_are_told_apart():
    short = Unidirectional(speed=0.1, track_length="0.15 mm", duration=2)
    bodies = [named("ball", Cylinder(radius="5 mm"), steel(), archard()), pair(None, archard())[1]]
    line = {"grid": Grid((0.7e-3, 0.7e-3), (40, 4)), "bodies": bodies, "ends_at_window": True}
    (found,) = begin(small(kinematics=short, **line)).findings
    assert found.kind == "averaging"
    assert found.value == pytest.approx(1.5e-4)


def test_a_run_stopped_before_its_first_checkpoint_says_so_and_can_start_again(
    tmp_path, monkeypatch
):
    path = tmp_path / "run.h5"
    with monkeypatch.context() as disk:
        full = OSError(errno.ENOSPC, "No space left on device")
        disk.setattr(checkpoint, "write_sealed", Mock(side_effect=full))
        with (
            pytest.warns(TriboWarning, match="No space left"),
            pytest.raises(OutputError, match="No space left on device; free space or choose"),
        ):
            Simulation(case(**SHORT)).run(path)
    with pytest.raises(CaseError, match=r"before its first save; .* run --force"):
        Simulation(case(**SHORT)).resume(path)
    assert Simulation(case(**SHORT)).run(path, overwrite=True).status == "done"


def test_replacing_a_result_drops_its_checkpoints(tmp_path):
    path = tmp_path / "run.h5"
    with pytest.raises(Interrupted):
        Simulation(case()).run(path, observers=[Stopper(after=5)])
    short = case(load=50.0, kinematics=motion(duration=1))
    Simulation(short).run(path, overwrite=True).close()
    assert [p.name for p in tmp_path.iterdir()] == ["run.h5"]


def test_steps_shorten_before_a_save_and_are_long_again_after_it():
    times = Simulation(case(save_times=(100,))).run().table("history")["distance_m"]
    steps = np.diff(times)
    at = int(np.flatnonzero(np.isclose(times, 10.0))[0])
    assert steps[at - 1] <= 1.5 * 0.01 * 10.0
    assert steps[at] > 2 * steps[at - 1]


@pytest.mark.parametrize("stepping", [Implicit(), Explicit(time_step=0.25)])
@pytest.mark.parametrize("before", [1e-7, 1e-8, 1e-9, 1e-12])
def test_a_save_just_before_a_reversal_or_the_end_is_made(stepping, before):
    # There the path of a sine grows by less than its rounding.
    saves = (5 - before, 5.0, 10 - before)
    given = motion(frequency=1, duration=10, waveform="sinusoidal")
    model = small(kinematics=given, save_times=saves, stepping=stepping)
    with Simulation(model.case).run() as result:
        assert tuple(result.times) == (0.0, *saves, 10.0)
        assert np.all(np.diff(result.distances) >= 0)
        assert result.distances[[1, 2, 4]] == pytest.approx([0.02, 0.02, 0.04], rel=1e-9)
        first, second = (result.body("disk").wear_depth[save] for save in (1, 2))
        assert second == pytest.approx(first, rel=1e-9, abs=0)
