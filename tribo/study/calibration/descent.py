"""The least of a function that runs compute, by L-BFGS."""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import numpy as np
from scipy.optimize import minimize

from tribo.core.arrays import Array
from tribo.core.errors import NumericalError

MEMORY = 30
"""Steps that L-BFGS remembers."""
FALL = 0.05
"""Fall of −ln p that errors of the steps of a run hide."""
SMALL = 2
"""Steps in a row that fall by less, which end it."""


class _TooFar(Exception):
    """A step to where nothing can be computed."""


def descended(function: Callable[[Array], tuple[float, Array]], start: Array, steps: int) -> Array:
    """Return where a function with its gradient is least, or the least after a number of steps.

    A step to where it cannot be computed ends the descent; `NumericalError` only at the start.
    """
    best, least, former, small = start, math.inf, math.inf, 0

    def tried(point: Array) -> tuple[float, Array]:
        nonlocal best, least
        try:
            value, slope = function(point)
        except NumericalError:
            if math.isinf(least):
                raise
            raise _TooFar from None
        if value < least:
            best, least = np.copy(point), value
        return value, slope

    def settled(intermediate_result: Any) -> None:
        nonlocal former, small
        before, former = former, float(intermediate_result.fun)
        small = small + 1 if before - former < FALL else 0
        if small == SMALL:
            raise StopIteration

    options = {"maxiter": steps, "ftol": 0.0, "maxcor": MEMORY}
    with suppress(_TooFar):
        minimize(tried, start, jac=True, method="L-BFGS-B", callback=settled, options=options)
    return best
