"""Materials are bounded by physics, and two of them share one contact modulus."""

from __future__ import annotations

import pytest

from tribo import CaseError
from tribo.core.material import Material, contact_modulus


def test_the_contact_modulus_adds_the_compliances_of_both() -> None:
    steel, soft = Material(young=207e9, poisson=0.3), Material(young=1e9, poisson=0.4)
    assert contact_modulus([steel, steel]) == pytest.approx(207e9 / (2 * 0.91), rel=1e-15)
    assert 1 / contact_modulus([steel, soft]) == pytest.approx(0.91 / 207e9 + 0.84e-9, abs=0)


@pytest.mark.parametrize(
    "wrong", [{"poisson": -1}, {"poisson": 0.5}, {"poisson": float("nan")}, {"young": 0}]
)
def test_its_numbers_are_bounded_by_physics(wrong: dict[str, float]) -> None:
    with pytest.raises(CaseError):
        Material(**{"young": 1e9, "poisson": 0.3, **wrong})
