"""`tribo verify` notices wrong physics: each mutant is one plausible mistake."""

from dataclasses import replace

import pytest

from tribo.contact import dcfft, love, operator, periodic
from tribo.core.fields import WearRate
from tribo.core.material import contact_modulus
from tribo.lab import ball, track
from tribo.motion.exposure import Track
from tribo.simulation import assembly
from tribo.simulation.guards import GuardedSolver
from tribo.stepping import implicit, rates, step
from tribo.verification.check import run_check
from tribo.verification.suite import CHECKS
from tribo.wear.archard import Archard
from tribo.wear.power import Power

CACHES = (dcfft._half_space, periodic._half_space, love.nyquist_compliance)


@pytest.fixture
def patch(monkeypatch):
    """Return `monkeypatch.setattr`; operators of before and after are not mixed."""
    for cache in CACHES:
        cache.cache_clear()
    yield monkeypatch.setattr
    for cache in CACHES:
        cache.cache_clear()


def verdicts(text):
    checks = [check for check in CHECKS if text in check.case]
    assert checks
    return {row.verdict for check in checks for row in run_check(check)}


def second_modulus_ignored(patch):
    patch(assembly, "contact_modulus", lambda materials: contact_modulus([materials[0]] * 2))


def second_body_rigid(patch):
    patch(assembly, "contact_modulus", lambda materials: contact_modulus(materials[:1]))


def poisson_left_out(patch):
    patch(assembly, "contact_modulus", lambda m: 1 / sum((1 - 0.3**2) / each.young for each in m))


def spacings_swapped(patch):
    kernel = operator.wrapped_kernel
    patch(operator, "wrapped_kernel", lambda shape, spacing: kernel(shape, spacing[::-1]))


def groove_not_drawn_out(patch):
    patch(Track, "envelope", lambda self, field: field)


def groove_never_settled(patch):
    patch(step, "_settle", lambda model, state: state)


def yields_twice_as_deep(patch):
    solve = GuardedSolver.solve

    def mutant(*given):
        solution = solve(*given)
        return replace(solution, overlap=2 * solution.overlap)

    patch(GuardedSolver, "solve", mutant)


def each_body_yields_by_the_whole(patch):
    plastic = assembly._plastic

    def shares(*given):
        cap, share = plastic(*given)
        return cap, {name: float(part > 0) for name, part in share.items()}

    patch(assembly, "_plastic", shares)


def exponent_one_more(patch):
    rate = Power.rate

    def mutant(self, local):
        found = rate(self, local)
        ratio = local.pressure / self.reference_pressure
        return WearRate(found.depth_rate * ratio, found.depth_slope * ratio)

    patch(Power, "rate", mutant)


def reference_pressure_left_out(patch):
    rate = Power.rate

    def mutant(self, local):
        found = rate(self, local)
        less = self.reference_pressure / 2e9
        return WearRate(found.depth_rate * less, found.depth_slope * less)

    patch(Power, "rate", mutant)


def hardness_left_out(patch):
    coefficient = Archard._coefficient

    def mutant(self, material):
        if self.K is None:
            return coefficient(self, material)
        return self.K

    patch(Archard, "_coefficient", mutant)


def one_coefficient_for_both(patch):
    def mutant(*given):
        found = rates.wear_rates(*given)
        return dict.fromkeys(found, next(iter(found.values())))

    patch(implicit, "wear_rates", mutant)


def scaled(module, name, factor):
    def mutate(patch):
        formula = getattr(module, name)
        patch(module, name, lambda *given: factor * formula(*given))

    mutate.__name__ = f"{name} × {factor}"
    return mutate


def groove_radius_16(patch):
    patch(track, "groove_radius", lambda width, area: width**3 / (16 * area))


MUTANTS = (
    (second_modulus_ignored, "two materials"),
    (second_body_rigid, "two materials"),
    (poisson_left_out, "two materials"),
    (spacings_swapped, "oblong cells"),
    (groove_not_drawn_out, "draws a groove"),
    (groove_never_settled, "draws a groove"),
    (yields_twice_as_deep, "times that load"),
    (each_body_yields_by_the_whole, "times that load"),
    (exponent_one_more, "flat pin under even pressure"),
    (reference_pressure_left_out, "flat pin under even pressure"),
    (hardness_left_out, "flat pin under even pressure"),
    (one_coefficient_for_both, "three times the coefficient"),
    (groove_radius_16, "by its width"),
    (scaled(track, "planimetric_area", 1.1), "by its width"),
    (scaled(track, "circular_groove_area", 1.1), "by its width"),
    (scaled(track, "reciprocating_track_volume", 1.1), "by its width"),
    (scaled(track, "block_on_ring_volume", 2), "by its width"),
    (scaled(ball, "conforming_ball_volume", 2), "size of its scar"),
    (scaled(ball, "flat_along_ball_volume", 2), "size of its scar"),
    (scaled(ball, "ball_cap_volume", 2), "size of its scar"),
)


@pytest.mark.parametrize(
    ("mutate", "text"), MUTANTS, ids=[mutate.__name__ for mutate, _ in MUTANTS]
)
def test_a_mutant_fails(patch, mutate, text):
    mutate(patch)
    assert "fails" in verdicts(text)


@pytest.mark.parametrize("text", sorted({text for _, text in MUTANTS}))
def test_what_notices_mutants_holds_without_them(text):
    assert verdicts(text) == {"holds"}


def test_cells_that_are_oblong_tell_the_periodic_kernels_sides_apart(patch):
    half_space = periodic.PeriodicHalfSpace
    patch(
        periodic,
        "PeriodicHalfSpace",
        lambda shape, spacing, modulus: half_space(shape, spacing[::-1], modulus),
    )
    assert "fails" in verdicts("full contact")
