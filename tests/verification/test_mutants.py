"""`tribo verify` notices wrong physics: each mutant is one plausible mistake."""

from dataclasses import replace

import numpy as np
import pytest

from tribo.contact import dcfft, love, padded_half_space, periodic
from tribo.core.fields import WearRate
from tribo.evolution import rates
from tribo.guards.parts import GuardedSolver
from tribo.lab import formulas
from tribo.motion.exposure import Track
from tribo.motion.stroke import Stroke
from tribo.simulation import assembly
from tribo.stepping import plastic_groove, step
from tribo.verification.suite import installed_cases
from tribo.wear.archard import Archard, Power


def without_poisson(right):
    return lambda materials: 1 / sum((1 - 0.3**2) / each.young for each in materials)


def sides_swapped(right):
    return lambda shape, spacing, *rest: right(shape, spacing[::-1], *rest)


def twice_the_overlap(right):
    def solve(*given):
        solution = right(*given)
        return replace(solution, overlap=2 * solution.overlap)

    return solve


def whole_depth_for_each(right):
    def shares(*given):
        cap, share, hardness = right(*given)
        return cap, {name: float(part > 0) for name, part in share.items()}, hardness

    return shares


def given_back(right):
    return lambda model, given, *rest: given


def added(right):
    return lambda _, parts: right(np.add, parts)


def mean_displaces(right):
    return lambda self, pressure: right(self, pressure) + np.mean(pressure) * self.symbol()[0, 0]


def other_way_round(right):
    return property(lambda self: right.fget(self)[::-1])


def times(factor):
    return lambda right: lambda *given: factor * right(*given)


def rate_times(factor):
    """Multiply a law's rate by `factor` of law and pressure."""

    def mutate(right):
        def rate(self, local):
            found, more = right(self, local), factor(self, local.pressure)
            return WearRate(found.depth_rate * more, found.depth_slope * more)

        return rate

    return mutate


def one_rate_for_both(right):
    def rates(*given):
        return [
            replace(each, wear=dict.fromkeys(each.wear, next(iter(each.wear.values()))))
            for each in right(*given)
        ]

    return rates


# What is replaced, what makes the mutant of it, and the case in which it must be noticed.
MODULUS, CASES = (assembly, "contact_modulus"), "hertz_two_materials"
YIELDS, FORMULAS = "hardness_above", "lab_formulas"
MUTANTS = {
    "second modulus ignored": (MODULUS, lambda right: lambda each: right([each[0]] * 2), CASES),
    "second body rigid": (MODULUS, lambda right: lambda each: right(each[:1]), CASES),
    "Poisson's ratio left out": (MODULUS, without_poisson, CASES),
    "sides of a cell swapped": (
        (padded_half_space, "wrapped_kernel"),
        sides_swapped,
        "hertz_ellipse",
    ),
    "sides swapped, periodic": ((periodic, "_cached"), sides_swapped, "wavy_closed"),
    "groove not drawn out": ((Track, "envelope"), given_back, "groove_track"),
    "groove never settled": ((step, "settled"), given_back, "groove_track"),
    "groove twice as deep": ((Track, "envelope"), times(2), "groove_track"),
    "overlaps of positions added up": ((plastic_groove, "reduce"), added, "groove_stroke"),
    "mean pressure displaces": (
        (periodic.PeriodicHalfSpace, "apply"),
        mean_displaces,
        "wavy_closed",
    ),
    "moving body the wrong way round": ((Stroke, "starts"), other_way_round, "lopsided_path"),
    "yields twice as deep": ((GuardedSolver, "solve"), twice_the_overlap, YIELDS),
    "each body yields by the whole": ((assembly, "yielding"), whole_depth_for_each, YIELDS),
    "exponent one more": (
        (Power, "rate"),
        rate_times(lambda law, pressure: pressure / law.reference_pressure),
        "power_3",
    ),
    "reference pressure left out": (
        (Power, "rate"),
        rate_times(lambda law, pressure: law.reference_pressure / 2e9),
        "power_3",
    ),
    "hardness left out": (
        (Archard, "_coefficient"),
        lambda right: lambda law, material: right(law, material) if law.K is None else law.K,
        "archard_hardness",
    ),
    "one coefficient for both": (
        (rates, "rates_at_each"),
        one_rate_for_both,
        "both_wear",
    ),
    "ends of a stroke worn in full": (
        (Stroke, "shares"),
        lambda right: property(lambda self: np.full(len(self.cells), 1 / len(self.cells))),
        "stroke_long",
    ),
    "groove radius by 16": ((formulas, "groove_radius"), times(12 / 16), FORMULAS),
    "section too large": ((formulas, "planimetric_area"), times(1.1), FORMULAS),
    "groove too large": ((formulas, "circular_groove_area"), times(1.1), FORMULAS),
    "straight track too large": ((formulas, "reciprocating_track_volume"), times(1.1), FORMULAS),
    "conforming scar doubled": ((formulas, "conforming_ball_volume"), times(2), FORMULAS),
    "flat scar doubled": ((formulas, "flat_along_ball_volume"), times(2), FORMULAS),
    "cap doubled": ((formulas, "ball_cap_volume"), times(2), FORMULAS),
}


@pytest.fixture
def no_operator_kept():
    caches = dcfft._cached, periodic._cached, love.nyquist_compliance
    for cache in caches:
        cache.cache_clear()
    yield
    for cache in caches:
        cache.cache_clear()


@pytest.mark.slow
@pytest.mark.usefixtures("no_operator_kept")
@pytest.mark.parametrize("name", MUTANTS)
def test_a_mutant_fails(monkeypatch, name):
    (owner, attribute), mutate, text = MUTANTS[name]
    monkeypatch.setattr(owner, attribute, mutate(getattr(owner, attribute)))
    case = next(case for case in installed_cases() if case.name == text)
    assert any(row.verdict == "fails" for row in case.run())
