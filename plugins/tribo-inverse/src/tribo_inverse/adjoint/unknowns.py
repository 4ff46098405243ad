"""An objective and its gradient as a function of one vector of unknowns."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from tribo import Array, Case, CaseError, Simulation
from tribo.kernel_api import Model

from tribo_inverse.adjoint.gradient import gradient
from tribo_inverse.adjoint.numbers import changed, find, listed
from tribo_inverse.adjoint.view import Objective
from tribo_inverse.recording.local import factor_shape


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
    model = Simulation(case).model
    shapes = {name: factor_shape(model, name) for name in listed(wear_rate)}
    return ValueAndGradient(model, objective, find(model.case, wrt), shapes)


@dataclass(frozen=True)
class ValueAndGradient:
    """An objective with its gradient, a function of one vector; see `value_and_gradient`."""

    model: Model
    objective: Objective | Mapping[float, Objective]
    numbers: Sequence[tuple[str, Sequence[tuple[Any, ...]], float]]
    shapes: Mapping[str, tuple[int, int]]

    @property
    def start(self) -> Array:
        """The unknowns of the case itself: 0."""
        return np.zeros(len(self.numbers) + sum(a * b for a, b in self.shapes.values()))

    @np.errstate(over="ignore")
    def at(self, unknowns: Array) -> tuple[Case, dict[str, Array]]:
        """Return the case and the factors on wear rates, by body, for a vector of unknowns.

        `CaseError` if its length differs from `start`, or the case refuses a number.
        """
        if np.shape(unknowns) != self.start.shape:
            raise CaseError(f"{np.size(unknowns)} unknowns were given; start has {self.start.size}")
        case, at = self.model.case, len(self.numbers)
        for (path, places, value), log in zip(self.numbers, unknowns[:at], strict=True):
            case = changed(case, path, places, float(value * np.exp(log)))
        factors = {}
        for name, shape in self.shapes.items():
            factors[name] = np.exp(unknowns[at : at + shape[0] * shape[1]]).reshape(shape)
            at += factors[name].size
        return case, factors

    def __call__(self, unknowns: Array) -> tuple[float, Array]:
        """Return the objective and its derivatives in the unknowns."""
        case, factors = self.at(unknowns)
        paths = [path for path, *_ in self.numbers]
        found = gradient(case, self.objective, paths, factors=factors)
        values = np.exp(unknowns[: len(paths)]) * [value for *_, value in self.numbers]
        parts = values * [found.parameters[path] for path in paths]
        maps = [found.wear_rate[name].ravel() for name in self.shapes]
        return found.value, np.concatenate([parts, *maps])
