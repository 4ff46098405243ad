"""The minimum of a function that needs runs, by L-BFGS."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.optimize import minimize
from tribo import Array, NumericalError

MEMORY = 30
"""Steps that L-BFGS remembers."""
FALL = 0.05
"""Fall of −ln p that errors of the steps of a run hide."""
MOST_WALLS, STEEP = 20, 10.0
"""Largest number of failed steps that are shortened, and the rise assumed there over the gain
expected of the step."""
SMALL = 2
"""Steps in a row with a smaller fall that end it."""


def descended(function: Callable[[Array], tuple[float, Array]], start: Array, steps: int) -> Array:
    """Return the minimum of a function with its gradient, or the lowest point after some steps.

    A step to a point where it cannot be computed is shortened; `NumericalError` after many.
    """
    best, least, slope_there, former = start, math.inf, start, math.inf
    small = walls = 0

    def tried(point: Array) -> tuple[float, Array]:
        nonlocal best, least, slope_there, walls
        try:
            value, slope = function(point)
        except NumericalError:
            walls += 1
            if math.isinf(least) or walls > MOST_WALLS:
                raise
            # A bowl about the best point, which a line search goes back in.
            off = point - best
            rise = STEEP * (1 + abs(float(np.sum(slope_there * off))))
            return least + rise, 2 * rise * off / np.sum(off * off)
        if value < least:
            best, least, slope_there = np.copy(point), value, slope
        return value, slope

    def settled(intermediate_result: Any) -> None:
        nonlocal former, small
        before, former = former, float(intermediate_result.fun)
        small = small + 1 if before - former < FALL else 0
        if small == SMALL:
            raise StopIteration

    options = {"maxiter": steps, "ftol": 0.0, "maxcor": MEMORY}
    minimize(tried, start, jac=True, method="L-BFGS-B", callback=settled, options=options)
    return best
