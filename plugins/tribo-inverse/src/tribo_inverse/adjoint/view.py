"""The input of an objective, a saved state, and its answer: a number and its seeds."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from numbers import Real
from typing import Any

import numpy as np
from tribo import Array, CaseError, Grid, State
from tribo.kernel_api import Model, unknown


@dataclass(frozen=True)
class View:
    """A saved state, the input of an objective.

    Parameters
    ----------
    model : Model
        The composed case.
    state : State
        The state.

    Examples
    --------
    >>> from tribo_inverse import Seeds, gradient
    >>> def mean_depth(view):
    ...     wear = view.wear("ball")
    ...     return float(wear.mean()), Seeds({"ball": np.full_like(wear, 1 / wear.size)})
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> round(1e9 * gradient(case, mean_depth, ["stop.depth"]).value, 1)  # in nm, over the window
    10.3
    """

    model: Model
    state: State

    @property
    def grid(self) -> Grid:
        """The window."""
        return self.model.grid

    @property
    def pressure(self) -> Array:
        """Pressure in the middle of the cycle, shape (nx, ny), in Pa."""
        return self.state.contact.pressure

    def wear(self, body: str) -> Array:
        """Return the depth worn off a body's own surface, in m.

        Shape (nx, ny); (1, ny) for a body averaged along its track, and (rows, ny) for a body
        that moves through a resolved cycle.
        """
        if not isinstance(body, str) or body not in self.state.bodies:
            raise CaseError(unknown("body", str(body), self.state.bodies))
        return self.state.bodies[body].wear

    def volume(self, body: str) -> float:
        """Return the volume worn off a body, in m³."""
        return self.model.cycle.maps[body].volume(self.wear(body))

    def cell(self, field: Array, x: float, y: float) -> tuple[int, int]:
        """Return the cell of a field, around the middle, that is nearest to a place, in m."""
        found = []
        for place, spacing, count in zip((x, y), self.grid.spacing, field.shape, strict=True):
            known = isinstance(place, Real) and math.isfinite(place)
            index = math.floor(place / spacing + 0.5 * count) if known else -1
            if not known or (count > 1 and not 0 <= index < count):
                raise CaseError(f"{place!r} is no place within {0.5 * count * spacing:g} m")
            found.append(index if count > 1 else 0)
        return found[0], found[1]


@dataclass(frozen=True)
class Seeds:
    """The derivatives of an objective with respect to a state.

    Parameters
    ----------
    wear : Mapping[str, ndarray], optional
        By the depth worn off a body, by name, of the shape of the depth, in 1/m.
    pressure : ndarray, shape (nx, ny), optional
        By the pressure in the middle of the cycle, in 1/Pa.
    time : float, optional
        By the time of the state, in 1/s.
    distance : float, optional
        By the distance slid until then, in 1/m.

    Examples
    --------
    >>> from tribo_inverse import Seeds
    >>> wear = np.array([[1e-6, 3e-6]])
    >>> value, seeds = wear.mean(), Seeds({"ball": np.full_like(wear, 1 / wear.size)})
    >>> seeds.wear["ball"].tolist()  # how the mean depth follows each cell
    [[0.5, 0.5]]
    """

    wear: Mapping[str, Array] = field(default_factory=dict)
    pressure: Array | None = None
    time: float = 0.0
    distance: float = 0.0


Objective = Callable[[View], tuple[float, Seeds]]
"""A function of a `View` that returns a number and its `Seeds`."""


def looked(objective: Objective, view: View) -> tuple[float, Seeds]:
    """Return the value and the seeds of an objective at a state.

    Raises
    ------
    CaseError
        If they are not a finite number and finite `Seeds` of the shapes of their variables.
    """
    name = getattr(objective, "__name__", type(objective).__name__)
    answer: Any = objective(view)
    match answer:
        case (value, Seeds(wear=Mapping()) as seeds):
            pass
        case _:
            raise CaseError(
                f"{name} gave {answer!r:.80}; an objective gives its value and Seeds by body"
            )
    parts: list[tuple[str, Any, tuple[int, ...]]] = [
        ("value", value, ()),
        ("seed by time", seeds.time, ()),
        ("seed by distance", seeds.distance, ()),
    ]
    if seeds.pressure is not None:
        parts.append(("seed by pressure", seeds.pressure, view.pressure.shape))
    for body, seed in seeds.wear.items():
        parts.append((f"seed by the wear of {body}", seed, view.wear(body).shape))
    for what, given, shape in parts:
        try:
            array = np.asarray(given, dtype=np.float64)
        except (TypeError, ValueError):
            array = np.array(np.nan)
        if array.shape != shape or not np.all(np.isfinite(array)):
            raise CaseError(f"the {what} of {name} must be finite, of the shape {shape}")
    return float(value), seeds
