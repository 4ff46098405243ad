"""Objectives: numbers of a saved state, and their derivatives in it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from tribo import CaseError

from tribo_inverse.adjoint.view import Seeds, View


@dataclass(frozen=True)
class Volume:
    """The volume worn off a body, in m³.

    Examples
    --------
    >>> from tribo_inverse import Volume, gradient
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> round(1e9 * gradient(case, Volume("ball"), ["stop.depth"]).value, 6)  # in mm³
    4.1e-05
    """

    body: str

    def __call__(self, view: View) -> tuple[float, Seeds]:
        """Return the volume, and the volume per depth of each cell."""
        wear, volume = view.wear(self.body), view.model.cycle.maps[self.body].volume
        rows, columns = wear.shape
        # Rows along x may be of different length, of equal cells.
        each = [volume(np.tile(row, (rows, 1))) / rows for row in np.eye(columns)]
        return view.volume(self.body), Seeds({self.body: np.tile(each, (rows, 1))})


@dataclass(frozen=True)
class Depth:
    """The depth worn off a body at a place, in m: of the cell nearest to `x` and `y`, in m.

    Places count from the middle of its own surface; `x` has no effect on an averaged body.

    Examples
    --------
    >>> from tribo_inverse import Depth, gradient
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> found = gradient(case, Depth("ball", x=1e-4), ["stop.depth"])
    >>> round(1e6 * found.value, 2)  # in µm, where 1 µm is worn in the middle
    0.52
    """

    body: str
    x: float = 0.0
    y: float = 0.0

    def __call__(self, view: View) -> tuple[float, Seeds]:
        """Return the depth, and 1 at its cell."""
        wear = view.wear(self.body)
        cell, seed = view.cell(wear, self.x, self.y), np.zeros_like(wear)
        seed[cell] = 1.0
        return float(wear[cell]), Seeds({self.body: seed})


@dataclass(frozen=True)
class Deepest:
    """The largest depth worn off a body, in m, made smooth: Σ wᵐ / Σ wᵐ⁻¹ with m = `order` ≥ 2.

    It is below the largest depth, by 1/m of it for a scar with a round bottom.

    Examples
    --------
    >>> from tribo_inverse import Deepest, gradient
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> round(1e6 * gradient(case, Deepest("ball", order=10), ["stop.depth"]).value, 2)  # of 1 µm
    0.93
    """

    body: str
    order: float = 100.0

    def __call__(self, view: View) -> tuple[float, Seeds]:
        """Return the mean, and its derivative."""
        if not self.order >= 2:
            raise CaseError(f"Deepest has the order {self.order!r}; give 2 or more")
        wear = view.wear(self.body)
        most = float(np.max(wear))
        if most <= 0:
            return 0.0, Seeds({self.body: np.zeros_like(wear)})
        part, m = wear / most, self.order
        total = float(np.sum(part ** (m - 1)))
        mean = float(np.sum(part**m)) / total
        slope = (m * part ** (m - 1) - (m - 1) * mean * part ** (m - 2)) / total
        return most * mean, Seeds({self.body: slope})


@dataclass(frozen=True)
class Pressure:
    """The pressure in the middle of the cycle at a place, in Pa: of the cell nearest to it, in m.

    A cell that just touches has the derivative of an open cell, 0.

    Examples
    --------
    >>> from tribo_inverse import Pressure, gradient
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> middle = gradient(case, Pressure(), ["load.normal"])
    >>> round(1e-6 * middle.value), round(middle.relative["load.normal"], 2)  # MPa, % for 1 %
    (2146, 0.55)
    """

    x: float = 0.0
    y: float = 0.0

    def __call__(self, view: View) -> tuple[float, Seeds]:
        """Return the pressure, and 1 at its cell."""
        cell, seed = view.cell(view.pressure, self.x, self.y), np.zeros_like(view.pressure)
        seed[cell] = 1.0
        return float(view.pressure[cell]), Seeds(pressure=seed)


@dataclass(frozen=True)
class EndTime:
    """The time at which a depth ends a run, in s: the life of a body.

    Raises
    ------
    CaseError
        If no depth ended the run.

    Examples
    --------
    >>> from tribo_inverse import EndTime, gradient
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> round(gradient(case, EndTime(), ["load.normal"]).relative["load.normal"], 2)  # % for 1 %
    -0.45
    """

    def __call__(self, view: View) -> tuple[float, Seeds]:
        """Return the time, and 1; `CaseError` if no depth has ended the run."""
        model, time, depth = view.model, view.state.time, view.model.case.stop.depth
        if depth is not None and time < model.end_time:
            return time, Seeds(time=1.0)
        worn = (np.max(view.wear(name)) for name in model.case.stop.whose(model.case.bodies))
        raise CaseError(
            f"no depth ends the run: after {time:g} s the largest is {1e6 * max(worn):.3g} µm; "
            "give one, or the motion a longer duration",
            "stop.depth",
        )
