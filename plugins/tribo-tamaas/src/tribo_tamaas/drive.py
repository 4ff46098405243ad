"""Drive tamaas: a free-space contact in its own, nondimensional, units."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from tribo import Array, NumericalError

# Window's longer side where E* is 1. The capped solver takes steps of one length
# in these units: shorter sides make it slow (1 takes eight times as long), and it
# diverges on 20.
_SIDE = 8.0
_OPERATOR = "dcfft"


def pressure(
    gap: Array,
    size: tuple[float, float],
    modulus: float,
    load: float,
    cap: float | None = None,
    *,
    start: Array | None = None,
    tolerance: float,
    max_iterations: int,
) -> tuple[Array, int]:
    """Return the solution of tamaas, and its iterations.

    tamaas reports neither whether nor how well it converged, so the caller must
    judge the pressure.

    Parameters
    ----------
    gap : ndarray, shape (nx, ny)
        Undeformed gap, in m.
    size : tuple of float
        Edge lengths of the window along x and y, in m.
    modulus : float
        Contact modulus E*, in Pa.
    load : float
        Normal load, in N.
    cap : float, optional
        Largest pressure, in Pa.
    start : ndarray, shape (nx, ny), optional
        Pressure to start from, in Pa.
    tolerance : float
        tamaas's own normalised complementarity error.
    max_iterations : int
        Iterations after which tamaas ends without a word.

    Returns
    -------
    pressure : ndarray, shape (nx, ny)
        In Pa, within [0, cap].
    iterations : int
        Gradients that tamaas evaluated.

    Raises
    ------
    NumericalError
        If tamaas raises an error, or returns an invalid pressure.
    """
    import tamaas

    scale = _SIDE / max(size)
    model = tamaas.ModelFactory.createModel(
        tamaas.model_type.basic_2d, [edge * scale for edge in size], list(gap.shape)
    )
    model.E, model.nu = 1.0, 0.0
    tamaas.ModelFactory.registerNonPeriodic(model, _OPERATOR)
    heights = np.ascontiguousarray(-scale * gap)
    if cap is None:
        solver = tamaas.PolonskyKeerRey(model, heights, tolerance)
    else:
        solver = tamaas.KatoSaturated(model, heights, tolerance, cap / modulus)
    # Registering alone leaves the solver on its periodic operator.
    solver.setIntegralOperator(_OPERATOR)
    solver.max_iter = max_iterations
    counter = _counter(tamaas)
    solver.addFunctionalTerm(counter)
    if start is not None:
        model.traction[:] = (start / modulus).reshape(model.traction.shape)
    try:
        with _quiet(tamaas):
            solver.solve(load / (size[0] * size[1]) / modulus)
    except Exception as error:
        raise NumericalError(f"tamaas stopped with: {error}") from error
    found = np.array(model.traction, dtype=np.float64).reshape(gap.shape)
    if not (np.isfinite(found).all() and float(np.max(found)) > 0):
        raise NumericalError(
            "tamaas diverged: its pressure is not finite, or zero everywhere; check the gap for "
            "extreme values"
        )
    if cap is None:
        return np.maximum(found * modulus, 0.0), counter.count
    # So that cells at the cap bear it to the last bit.
    capped = np.where(found >= cap / modulus, cap, found * modulus)
    return np.clip(capped, 0.0, cap), counter.count


def _counter(tamaas: Any) -> Any:
    """Return an energy that is zero, to count evaluations of its gradient."""

    class Counter(tamaas.Functional):  # type: ignore[misc]
        def __init__(self) -> None:
            super().__init__()
            self.count = 0

        def computeF(self, _variable: object, _dual: object) -> float:  # noqa: N802
            return 0.0

        def computeGradF(self, _variable: object, _gradient: object) -> None:  # noqa: N802
            self.count += 1

    return Counter()


@contextmanager
def _quiet(tamaas: Any) -> Iterator[None]:
    before = tamaas.get_log_level()
    tamaas.set_log_level(tamaas.LogLevel.error)
    try:
        yield
    finally:
        tamaas.set_log_level(before)
