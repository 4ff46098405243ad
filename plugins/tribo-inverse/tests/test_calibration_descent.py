"""A descent ends where errors of runs hide what is left, and where nothing can be computed."""

import numpy as np
import pytest
from tribo.core.errors import NumericalError

from tribo_inverse.calibration.descent import descended

LEAST, SIZES = np.array([1.0, -2.0, 0.5]), np.array([1.0, 3.0, 10.0])


def bowl(point, sizes=SIZES):
    off = point - LEAST
    return float(np.sum(sizes * off**2)), 2 * sizes * off


def test_the_least_is_found():
    assert descended(bowl, np.zeros(3), 100) == pytest.approx(LEAST, abs=0.3)


def test_errors_of_runs_do_not_keep_it_going():
    random, runs = np.random.default_rng(0), 0

    def shaken(point):
        nonlocal runs
        runs += 1
        value, slope = bowl(point, np.full(3, 1e6))
        return value + 0.02 * random.random(), slope

    found = descended(shaken, LEAST + 1e-7, 100)
    assert runs < 30
    assert found == pytest.approx(LEAST, abs=1e-3)


def test_a_step_to_where_nothing_can_be_computed_is_shortened():
    """The first step of L-BFGS has the length 1."""
    refused = 0

    def walled(point):
        nonlocal refused
        if np.max(np.abs(point - LEAST)) > 0.3:
            refused += 1
            raise NumericalError("no step")
        return bowl(point, 1e3 * SIZES)

    assert descended(walled, LEAST + 0.2, 100) == pytest.approx(LEAST, abs=0.02)
    assert refused > 0
    with pytest.raises(NumericalError, match="no step"):
        descended(walled, LEAST + 1, 100)
