"""An objective and its gradient as a function of one vector of unknowns."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import ValidationError
from tribo import Array, Case, CaseError, Simulation
from tribo.kernel_api import Model

from tribo_inverse.adjoint.gradient import gradient
from tribo_inverse.adjoint.numbers import changed, find, listed
from tribo_inverse.adjoint.view import Objective
from tribo_inverse.recording.local import factor_shape

FURTHEST = 30.0
"""Largest change of the logarithm of a number that is evaluated."""


def value_and_gradient(
    case: Case | Mapping[str, Any] | str | Path | Model,
    objective: Objective | Mapping[float, Objective],
    wrt: Sequence[str] = (),
    wear_rate: Sequence[str] = (),
) -> ValueAndGradient:
    """Return an objective with its gradient, for ``scipy.optimize.minimize(…, jac=True)``.

    The unknowns are the logarithms of numbers of the case, relative to their values there, and of
    factors on wear rates at each cell of bodies: one vector, whose `start` is all 0.

    Parameters
    ----------
    case : Case, Mapping, str, Path or Model
        As `gradient` takes it.
    objective : callable, or Mapping of float to callable
        As `gradient` takes it.
    wrt : sequence of str, optional
        Paths of the numbers.
    wear_rate : sequence of str, optional
        Bodies whose wear rate has a factor at each cell.

    Returns
    -------
    callable
        A function of the vector of unknowns, with `start` and `at`.

    Raises
    ------
    CaseError
        If a path leads to no number, or a body does not wear.

    Examples
    --------
    >>> from tribo_inverse import EndTime, value_and_gradient
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> fit = value_and_gradient(case, EndTime(), ["bodies.*.wear.k"])
    >>> life, slope = fit(fit.start)
    >>> round(life, 1), slope.round(1).tolist()  # half of it for twice k
    (13.2, [-13.2])
    """
    return ValueAndGradient(case, objective, wrt, wear_rate)


class ValueAndGradient:
    """An objective with its gradient, a function of one vector; see `value_and_gradient`."""

    def __init__(
        self,
        case: Case | Mapping[str, Any] | str | Path | Model,
        objective: Objective | Mapping[float, Objective],
        wrt: Sequence[str],
        wear_rate: Sequence[str],
    ) -> None:
        self._model = Simulation(case).model
        self._objective = objective
        self._numbers = find(self._model.case, wrt)
        self._shapes = {name: factor_shape(self._model, name) for name in listed(wear_rate)}

    @property
    def start(self) -> Array:
        """The unknowns of the case itself: 0."""
        return np.zeros(len(self._numbers) + sum(a * b for a, b in self._shapes.values()))

    @np.errstate(over="ignore")
    def at(self, unknowns: Array) -> tuple[Case, dict[str, Array]]:
        """Return the case and the factors on wear rates, by body, for a vector of unknowns.

        `CaseError` if its length differs from `start`, or the case refuses a number.
        """
        if np.shape(unknowns) != self.start.shape:
            raise CaseError(f"{np.size(unknowns)} unknowns were given; start has {self.start.size}")
        case, at = self._model.case, len(self._numbers)
        for (path, places, value), log in zip(self._numbers, unknowns[:at], strict=True):
            if abs(log) > FURTHEST:
                raise CaseError(
                    f"was asked for {log:+.3g} away in its logarithm: a step of the optimiser went "
                    "too far; give it bounds, as method='L-BFGS-B', "
                    "bounds=[(-2, 2)] * len(fit.start)",
                    path,
                )
            number = float(value * np.exp(log))
            try:
                for place in places:
                    case = changed(case, place, number)
            except ValidationError as error:
                raise CaseError(
                    f"may not be {number:g}: {error.errors()[0]['msg']}", path
                ) from None
        factors = {}
        for name, shape in self._shapes.items():
            factors[name] = np.exp(unknowns[at : at + shape[0] * shape[1]]).reshape(shape)
            at += factors[name].size
        return case, factors

    def __call__(self, unknowns: Array) -> tuple[float, Array]:
        """Return the objective and its derivatives in the unknowns."""
        case, factors = self.at(unknowns)
        paths = [path for path, *_ in self._numbers]
        found = gradient(case, self._objective, paths, factors=factors)
        values = np.exp(unknowns[: len(paths)]) * [value for *_, value in self._numbers]
        parts = values * [found.parameters[path] for path in paths]
        maps = [found.wear_rate[name].ravel() for name in self._shapes]
        return found.value, np.concatenate([parts, *maps])
