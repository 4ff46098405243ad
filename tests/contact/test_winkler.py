"""The `winkler` solver against closed forms and the conditions of contact."""

from dataclasses import replace

import numpy as np
import pytest
from contact_problems import HARDNESS, MODULUS, ball, problem

from tribo.closed_forms import hertz
from tribo.contact.winkler import Winkler
from tribo.core.contact import ContactSystem, WearCompliance
from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.core.measures import contact_area

FOUNDATION = 1.2973e15
SYSTEM = ContactSystem(Grid((1e-3, 2e-3), (8, 8)), MODULUS, 100.0, None, (200.0, 200.0))


def _fixed():
    return Winkler(modulus=FOUNDATION)


def _modulus(match, system=SYSTEM):
    return Winkler.model_validate({"match": match}).foundation_modulus(system)


@pytest.mark.parametrize("match", ["contact_radius", "peak_pressure", "approach"])
def test_matched_foundation_reproduces_that_feature_of_an_ellipse(match):
    case = ball(256, radii=(10e-3, 5e-3), width=1.2e-3)
    case = replace(case, system=replace(case.system, curvature=(100.0, 200.0)))
    solution = Winkler.model_validate({"match": match}).solve(case)
    exact = hertz.point(MODULUS, 100.0, 100.0, 200.0)
    found, wanted = {
        "contact_radius": (
            contact_area(solution.pressure, case.system.grid),
            np.pi * exact.semi_axes[0] * exact.semi_axes[1],
        ),
        "peak_pressure": (solution.pressure.max(), exact.peak_pressure),
        "approach": (solution.approach, exact.approach),
    }[match]
    assert found == pytest.approx(wanted, rel=3e-3)


@pytest.mark.parametrize("curvature", [None, (0.0, 0.0), (-1.0, 200.0)])
def test_without_curvature_there_is_nothing_to_match(
    curvature,
):
    with pytest.raises(CaseError, match=r"Give modulus .* or layer"):
        Winkler().check(replace(SYSTEM, curvature=curvature))
    _fixed().check(replace(SYSTEM, curvature=curvature))


def test_approach_of_a_line_contact_cannot_be_matched():
    with pytest.raises(CaseError, match="no finite value"):
        _modulus("approach", replace(SYSTEM, curvature=(0.0, 200.0)))


def test_two_sources_of_the_modulus_are_refused_by_name():
    with pytest.raises(CaseError, match="modulus and match are given"):
        Winkler(modulus=1e15, match="approach")


@pytest.mark.parametrize("seed", range(6))
def test_conditions_hold_to_round_off(seed):
    rng = np.random.default_rng(seed)
    shape, size = (13, 9), (1e-3, 8e-4)
    load = 10 ** rng.uniform(-2, 3)
    cap = None if seed % 3 == 0 else load / (size[0] * size[1]) * (1.02, 3.0)[seed % 3 - 1]
    wear = None
    if seed % 2:
        local, swept = 10 ** rng.uniform(-2, 2, 2) / FOUNDATION
        wear = WearCompliance(local * rng.random(shape), swept / 1e-3 * rng.random(9))
    case = problem(rng.random(shape) * 10 ** rng.uniform(-7, -5), size, load, cap, wear)
    solution = _fixed().solve(case)
    p, grid = solution.pressure, case.system.grid
    displacement = p / FOUNDATION
    if wear is not None:
        displacement += wear.local * p + wear.swept * grid.spacing[0] * p.sum(axis=0)
    g = case.gap + displacement - solution.approach
    tiny = 1e-13 * (np.abs(solution.approach) + displacement.max())
    full = p == cap if cap is not None else np.zeros(shape, dtype=bool)
    assert p.sum() * grid.cell_area == pytest.approx(load, rel=1e-14, abs=0)
    assert (g[p <= 0] > -tiny).all()
    assert np.abs(g[(p > 0) & ~full]).max(initial=0) < tiny
    assert (g[full] < tiny).all()
    assert solution.overlap == pytest.approx(np.where(full, -g, 0), abs=tiny)


@pytest.mark.parametrize("load", [1e-320, 1e-300, 1e6])
def test_a_load_lost_in_rounding_or_too_large_for_the_window_is_an_error(load: float) -> None:
    with pytest.raises(CaseError, match=r"is lost in rounding|enlarge grid\.size"):
        _fixed().solve(replace(ball(16, cap=HARDNESS), load=load))
