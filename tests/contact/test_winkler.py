"""The `winkler` solver where nothing can be matched."""

from dataclasses import replace

import pytest
from contact_problems import MODULUS

from tribo.contact.winkler import Winkler
from tribo.core.contact import ContactSystem
from tribo.core.errors import CaseError
from tribo.core.grid import Grid

SYSTEM = ContactSystem(Grid((1e-3, 2e-3), (8, 8)), MODULUS, 100.0, None, (200.0, 200.0))


def _modulus(match, system=SYSTEM):
    return Winkler.model_validate({"match": match}).foundation_modulus(system)


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
