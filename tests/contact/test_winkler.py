"""The `winkler` solver against closed forms."""

from dataclasses import replace

import numpy as np
import pytest
from contact_problems import MODULUS, ball

from tribo.closed_forms import hertz
from tribo.contact.winkler import Winkler
from tribo.core.contact import ContactSystem
from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.core.measures import contact_area

SYSTEM = ContactSystem(Grid((1e-3, 2e-3), (8, 8)), MODULUS, 100.0, None, (200.0, 200.0))


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
    Winkler(modulus=1e15).check(replace(SYSTEM, curvature=curvature))


def test_approach_of_a_line_contact_cannot_be_matched():
    with pytest.raises(CaseError, match="no finite value"):
        _modulus("approach", replace(SYSTEM, curvature=(0.0, 200.0)))


def test_two_sources_of_the_modulus_are_refused_by_name():
    with pytest.raises(CaseError, match="modulus and match are given"):
        Winkler(modulus=1e15, match="approach")
