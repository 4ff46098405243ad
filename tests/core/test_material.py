"""Materials are bounded by physics, and two of them share one contact modulus."""

from __future__ import annotations

import pytest

from tribo import CaseError
from tribo.core.material import Material


@pytest.mark.parametrize(
    "wrong", [{"poisson": -1}, {"poisson": 0.5}, {"poisson": float("nan")}, {"young": 0}]
)
def test_its_numbers_are_bounded_by_physics(wrong: dict[str, float]) -> None:
    with pytest.raises(CaseError):
        Material(**{"young": 1e9, "poisson": 0.3, **wrong})
