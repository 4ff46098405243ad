"""Materials are bounded by physics, and two of them share one contact modulus."""

from __future__ import annotations

import pytest
from pydantic import ValidationError

from tribo.core.material import Material, contact_modulus


def test_contact_modulus_of_equal_bodies_is_half_of_one() -> None:
    steel = Material(young=207e9, poisson=0.3)
    assert contact_modulus([steel, steel]) == pytest.approx(207e9 / (2 * 0.91), rel=1e-15)


def test_a_rigid_partner_leaves_the_plane_strain_modulus() -> None:
    soft, rigid = Material(young=1e9, poisson=0.4), Material(young=1e30, poisson=0.4)
    assert contact_modulus([soft, rigid]) == pytest.approx(1e9 / (1 - 0.16), rel=1e-12)


@pytest.mark.parametrize("poisson", [-1, 0.5, 0.7, float("nan")])
def test_poisson_is_between_minus_one_and_a_half(poisson: float) -> None:
    with pytest.raises(ValidationError):
        Material(young=1e9, poisson=poisson)


@pytest.mark.parametrize("young", [0, -1, float("inf")])
def test_moduli_are_positive(young: float) -> None:
    with pytest.raises(ValidationError):
        Material(young=young, poisson=0.3)


def test_a_material_cannot_be_changed() -> None:
    steel = Material(young=207e9, poisson=0.3)
    with pytest.raises(ValidationError):
        steel.young = 1.0  # type: ignore[misc]


def test_every_field_is_described_with_its_unit() -> None:
    for name, field in Material.model_json_schema()["properties"].items():
        assert field["description"], name
        assert "x-unit" in str(field), name
