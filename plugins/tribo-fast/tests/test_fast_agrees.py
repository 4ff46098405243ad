"""Compiled solves have the iterations and, to round-off, the pressure of NumPy's."""

import numpy as np
import pytest
from tribo import Coating, CycleCompliance, HalfSpace, Material, NumericalError, WearCompliance
from tribo.contact.bounded_cg import Iterate, solve_together
from tribo.kernel_api import PeriodicHalfSpace

import tribo_fast
from tribo_fast import passes
from tribo_fast.iterate import CompiledIterate

CELLS, SPACING, MODULUS, LOAD = (32, 27), (2.5e-5, 3e-5), 1.15e11, 60.0
STEEL = Material(young="207 GPa", poisson=0.3)
LAYER = Coating(4e-6, Material(young="400 GPa", poisson=0.2), base=STEEL)
NUMBERS = np.random.default_rng(0)
x, y = ((np.arange(n) - n / 2 + 0.5) * d for n, d in zip(CELLS, SPACING, strict=True))
BALL = (x[:, None] ** 2 + y**2) / 10e-3
ROUGH = 5e-8 * NUMBERS.standard_normal((3, *CELLS))
ROUGH -= ROUGH.min()
CAPS = 2e9 * (1 + NUMBERS.random(CELLS))
LOADS = np.array([60.0, 45.0, 70.0])
SHARES = np.array([0.2, 0.5, 0.3])
OWN = WearCompliance(2e-18 * NUMBERS.random(CELLS), 1e-14 * NUMBERS.random(CELLS[1]))
STAYS, PASSES = 2e-18 * NUMBERS.random(CELLS), 2e-18 * NUMBERS.random((45, CELLS[1]))
PLACES = ((0, 0), (8, 3), (20, -4))
COUPLED = CycleCompliance(SHARES, [(STAYS, ((0, 0),) * 3), (PASSES, PLACES)], slice(0, CELLS[0]))
MIRRORED = CycleCompliance(SHARES, [(PASSES, PLACES)], slice(0, CELLS[0]), mirrored=True)
UNWORN = CycleCompliance(SHARES, [], slice(0, CELLS[0]))

free, flat = HalfSpace(CELLS, SPACING, MODULUS), PeriodicHalfSpace(CELLS, SPACING, MODULUS)
coated = HalfSpace(CELLS, SPACING, MODULUS, (LAYER,))
AREA = BALL.size * SPACING[0] * SPACING[1]
STEP = np.where(x[:, None] < 0, 0.0, 1.0) + 0 * y
even = PeriodicHalfSpace((32, 28), SPACING, MODULUS)
several = BALL + ROUGH
PROBLEMS = {
    "ball": (free, BALL, LOAD),
    "rough ball": (free, several[0], LOAD),
    "coated": (coated, BALL, LOAD),
    "yielding": (free, BALL, LOAD, 2e9),
    "a cap of each cell": (free, several[0], LOAD, CAPS),
    "nearly all at the cap": (free, BALL, LOAD, 1.02 * LOAD / AREA),
    "all at the cap": (free, BALL, LOAD, LOAD / AREA),
    "at the cap or apart": (free, STEP, LOAD, 2 * LOAD / AREA),
    "periodic": (flat, ROUGH[0], 0.2 * LOAD),
    "periodic of an even width": (even, np.pad(ROUGH[0], ((0, 0), (0, 1))), 0.2 * LOAD),
    "periodic, yielding": (flat, ROUGH[0], LOAD, 1e9),
    "worn": (free, several[0], LOAD, None, OWN),
    "worn, yielding": (free, several[0], LOAD, 2e9, OWN),
    "positions": (free, several, LOADS),
    "periodic positions": (flat, ROUGH, 0.2 * LOADS),
    "coupled": (free, several, LOADS, None, COUPLED),
    "coupled, yielding": (free, several, LOADS, 2e9, COUPLED),
    "coupled, caps of cells": (free, several, LOADS, CAPS * SHARES[:, None, None] / 0.3, COUPLED),
    "mirrored": (free, several, LOADS, None, MIRRORED),
    "coupled without wear": (free, several, LOADS, None, UNWORN),
}


@pytest.fixture
def everywhere(monkeypatch):
    monkeypatch.setattr(tribo_fast, "FEWEST", 0)


def solved(monkeypatch, threads, operator, gap, load, *more, **named):
    monkeypatch.setenv("TRIBO_FAST", str(threads))
    return solve_together(operator, gap, np.asarray(load), *more, **named)


def assert_equal(compiled, known):
    for one, other in zip(compiled, known, strict=True):
        assert one.iterations == other.iterations
        largest = float(other.pressure.max())
        assert one.pressure == pytest.approx(other.pressure, rel=0, abs=1e-12 * largest)
        assert one.approach == pytest.approx(other.approach, rel=1e-12, abs=0)
        deepest = max(float(other.overlap.max()), 1e-6)
        assert one.overlap == pytest.approx(other.overlap, rel=0, abs=1e-12 * deepest)
        for name, error in vars(other.residuals).items():
            assert getattr(one.residuals, name) == pytest.approx(error, rel=1e-3, abs=1e-13)


@pytest.mark.parametrize("problem", PROBLEMS.values(), ids=PROBLEMS)
def test_a_compiled_solve_is_that_of_numpy(problem, everywhere, monkeypatch):
    assert_equal(*(solved(monkeypatch, threads, *problem) for threads in (1, 0)))


@pytest.mark.parametrize("name", ["rough ball", "coupled, yielding"])
def test_a_warm_solve_is_that_of_numpy(name, everywhere, monkeypatch):
    problem = PROBLEMS[name]
    start = np.roll(np.stack([each.pressure for each in solved(monkeypatch, 0, *problem)]), 2, -1)
    start = start.reshape(problem[1].shape)
    assert_equal(*(solved(monkeypatch, threads, *problem, start=start) for threads in (1, 0)))


@pytest.mark.parametrize("name", ["rough ball", "worn, yielding", "coupled"])
def test_the_step_along_the_gradient_is_that_of_numpy(name, everywhere, monkeypatch):
    for cls in (Iterate, CompiledIterate):
        monkeypatch.setattr(cls, "conjugate_step", _refused_in_turn(cls.conjugate_step))
    # Not to the end: projected gradients amplify round-off.
    limits = {"tolerance": 1e-3}
    assert_equal(*(solved(monkeypatch, n, *PROBLEMS[name], **limits) for n in (1, 0)))


def _refused_in_turn(step):
    def stepped(iterate):
        iterate.turns = getattr(iterate, "turns", 0) + 1
        if iterate.turns % 4:
            return step(iterate)
        iterate.decrease = np.inf
        return False

    return stepped


@pytest.mark.parametrize("name", ["rough ball", "coupled"])
def test_it_converges_where_no_direction_leads_downhill_but_that_of_the_residual(
    name, everywhere, monkeypatch
):
    (known, *_) = solved(monkeypatch, 0, *PROBLEMS[name])
    advance, factors = CompiledIterate._advance, []

    def uphill(iterate, beta):
        advance(iterate, beta)
        factors.append(beta)
        if beta:
            iterate._sums[:, passes.ALONG] = 1.0

    monkeypatch.setattr(CompiledIterate, "_advance", uphill)
    (contact, *_) = solved(monkeypatch, 1, *PROBLEMS[name])
    assert {factor > 0 for factor in factors} == {True, False}
    largest = float(known.pressure.max())
    assert contact.pressure == pytest.approx(known.pressure, rel=0, abs=1e-5 * largest)


@pytest.mark.parametrize("name", ["coupled", "coupled, yielding", "positions"])
@pytest.mark.parametrize("threads", [2, 3, 5])
def test_bits_do_not_depend_on_threads(name, threads, everywhere, monkeypatch):
    one, other = (solved(monkeypatch, n, *PROBLEMS[name]) for n in (1, threads))
    for a, b in zip(one, other, strict=True):
        assert a.iterations == b.iterations
        assert (a.pressure == b.pressure).all()
        assert a.approach == b.approach


def test_fields_have_any_order_and_type(everywhere, monkeypatch):
    gap, cap, start = (np.asfortranarray(np.float32(each)) for each in (BALL, CAPS, CAPS))
    wear = WearCompliance(np.asfortranarray(OWN.local), np.float32(OWN.swept))
    problem = free, gap, LOAD, cap.astype(int), wear
    assert_equal(*(solved(monkeypatch, n, *problem, start=start) for n in (1, 0)))


@pytest.mark.parametrize("threads", [0, 1])
def test_fields_of_another_shape_are_refused(threads, everywhere, monkeypatch):
    for gap, cap, start in (
        (BALL[:30], None, None),
        (BALL[:1], None, None),
        (BALL, CAPS.T, None),
        (BALL, None, CAPS.T),
    ):
        with pytest.raises(ValueError, match="broadcast"):
            solved(monkeypatch, threads, free, gap, LOAD, cap, start=start)


@pytest.mark.parametrize("threads", [0, 1])
def test_a_load_lost_in_rounding_is_refused(threads, everywhere, monkeypatch):
    gap = BALL + 1e8 * NUMBERS.random(CELLS)
    with pytest.raises(NumericalError):
        solved(monkeypatch, threads, free, gap, 1e-99, max_iterations=20)
