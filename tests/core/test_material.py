"""Materials are bounded by physics, and two of them share one contact modulus."""

from __future__ import annotations

import pytest

from tribo import CaseError
from tribo.core.material import Material, contact_modulus


def test_contact_modulus_of_equal_bodies_is_half_of_one() -> None:
    steel = Material(young=207e9, poisson=0.3)
    assert contact_modulus([steel, steel]) == pytest.approx(207e9 / (2 * 0.91), rel=1e-15)


def test_a_rigid_partner_leaves_the_plane_strain_modulus() -> None:
    soft, rigid = Material(young=1e9, poisson=0.4), Material(young=1e30, poisson=0.4)
    assert contact_modulus([soft, rigid]) == pytest.approx(1e9 / (1 - 0.16), rel=1e-12)


@pytest.mark.parametrize(
    "wrong", [{"poisson": -1}, {"poisson": 0.5}, {"poisson": float("nan")}, {"young": 0}]
)
def test_its_numbers_are_bounded_by_physics(wrong: dict[str, float]) -> None:
    with pytest.raises(CaseError):
        Material(**{"young": 1e9, "poisson": 0.3, **wrong})
