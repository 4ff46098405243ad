"""Elastic-perfectly-plastic contact: pressure capped at the hardness."""

from __future__ import annotations

import numpy as np
import pytest
from contact_problems import HARDNESS, ONSET, ball, solver

from tribo.core.errors import CaseError


@pytest.mark.parametrize("room", [1.0, 1.0001, 1.02])
def test_window_that_just_bears_the_load_is_nearly_all_at_the_cap(room: float) -> None:
    width = np.sqrt(room * ONSET / HARDNESS)
    case = ball(48, ONSET, HARDNESS, width=float(width) * (1 + 1e-12))
    solution = solver().solve(case)
    full = np.count_nonzero(solution.pressure == HARDNESS) / case.gap.size
    # With a fiftieth to spare, the corners may bear a little less than the cap.
    assert full > (0.99 if room < 1.01 else 0.8)
    assert solution.residuals.worst <= 1e-8


def test_window_too_small_for_the_load_is_an_error_that_says_so() -> None:
    case = ball(48, ONSET, HARDNESS, width=0.9 * float(np.sqrt(ONSET / HARDNESS)))
    with pytest.raises(CaseError, match=r"bears no more than .* Enlarge the window"):
        solver().solve(case)
    with pytest.raises(CaseError, match="Enlarge the window"):
        solver().check(case.system)
