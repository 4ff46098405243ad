"""Observers that fail, or that would like to change what they watch."""

import numpy as np
import pytest
from zoo_keeper import Zoo, case_of, expect_harmless, expect_one_message

from tribo import Observer, Result, Simulation
from tribo.contact.dcfft import DcFft

ZOO, MEDDLERS = Zoo(), Zoo()


class Watcher(Observer):
    pass


def bad(words):
    return ZOO.bad(words, saved=True)


@bad("raised OSError: no screen")
class FailsAtTheStart(Watcher):
    def on_start(self, run):
        raise OSError("no screen")


@bad("raised KeyError: 'step'")
class FailsAtAStep(Watcher):
    def on_step(self, snapshot):
        if snapshot.state.steps > 10:
            raise KeyError("step")


@bad("raised RuntimeError: full")
class FailsAtASave(Watcher):
    @staticmethod
    def on_save(snapshot):
        if snapshot.state.time > 0:
            raise RuntimeError("full")


@bad("raised SystemExit: 1")
class Leaves(Watcher):
    def on_step(self, snapshot):
        raise SystemExit(1)


@bad("read-only")
class WritesIntoThePressure(Watcher):
    def on_step(self, snapshot):
        snapshot.state.contact.pressure[:] = 0


@bad("read-only")
class WritesIntoTheWear(Watcher):
    def on_step(self, snapshot):
        for body in snapshot.state.bodies.values():
            np.add(body.wear, 1e-3, out=body.wear)


@bad("raised FrozenInstanceError")
class SetsTheClock(Watcher):
    def on_save(self, snapshot):
        snapshot.state.time = 0.0


@MEDDLERS.bad("")
class ForgetsTheBodies(Watcher):
    def on_step(self, snapshot):
        snapshot.state.bodies.clear()
        snapshot.state.rates.clear()
        snapshot.measures.bodies.clear()


@MEDDLERS.bad("")
class ForgetsTheCase(Watcher):
    def on_start(self, run):
        run.case.clear()
        run.provenance.clear()
        run.system.materials.clear()
        run.bodies[0].height[:] = 0


@pytest.mark.parametrize("cls", ZOO.kept, ids=lambda cls: cls.__name__)
def test_it_ends_with_one_message(run, cls):
    expect_one_message(run(ZOO, cls), cls)


def test_none_harms_a_case_that_names_another(run):
    expect_harmless(run(ZOO))


@pytest.mark.parametrize("cls", MEDDLERS.kept, ids=lambda cls: cls.__name__)
def test_what_it_does_to_its_own_view_changes_no_bit(tmp_path, cls):
    results = []
    for name, classes in (("plain", ()), ("watched", (cls,))):
        case = tmp_path / f"{name}.toml"
        case.write_text(case_of(*classes))
        results.append(Simulation(case, MEDDLERS.registry()).run(case.with_suffix(".h5")))
    plain, watched = results
    assert plain.totals()["steps"] == watched.totals()["steps"]
    np.testing.assert_array_equal(plain.pressure(-1), watched.pressure(-1))
    np.testing.assert_array_equal(
        plain.body("ball").wear_depth[-1], watched.body("ball").wear_depth[-1]
    )
    assert len(watched.case["observers"]) == 1


def test_a_stopped_run_is_gone_on_with_though_an_observer_forgot_its_case(run, command):
    zoo = Zoo()

    @zoo.bad("")
    class ForgetsAndStops(ForgetsTheCase):
        def on_step(self, snapshot):
            if snapshot.state.steps == 5:
                raise KeyboardInterrupt

    assert run(zoo, ForgetsAndStops).code == 130
    expect_harmless(command(zoo, "resume", "case.h5"))


class FailsAtTheEnd(Watcher):
    def on_finish(self, snapshot, reason):
        raise ValueError("cannot say goodbye")


LAST_WORDS = "observer 'zoo.fails_at_the_end' raised ValueError: cannot say goodbye"


def test_what_fails_at_the_end_costs_no_result(run):
    zoo = Zoo()
    bad = zoo.bad("")(FailsAtTheEnd)
    ended = run(zoo, bad)
    assert ended.code == 3
    (line,) = ended.said
    assert line.startswith(f"error: {LAST_WORDS}")
    with Result.open(ended.path) as result:
        assert result.status == "done"


def test_of_a_run_that_failed_already_the_first_cause_is_the_error(run):
    zoo = Zoo()
    bad = zoo.bad("")(FailsAtTheEnd)

    @zoo.bad("")
    class Fails(DcFft):
        def solve(self, problem, start=None):
            return None if start is not None else super().solve(problem)

    ended = run(zoo, bad, Fails)
    assert ended.code == 3
    later, first, _ = ended.said
    assert later.startswith(f"warning: {LAST_WORDS}")
    assert first.startswith("error: contact solver 'zoo.fails' gave a NoneType")
    with Result.open(ended.path) as result:
        assert result.status == "failed"
        assert "zoo.fails'" in result.notices[-1]
