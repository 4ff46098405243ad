"""How a body's points meet the contact: stationary, or moving through it; the track average."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence

import numpy as np

from tribo.core.arrays import Array, Cell, region
from tribo.core.contact import WearCompliance
from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.core.words import unknown


class Exposure(ABC):
    """The surface map of a body: how its own surface meets the window at each position of a cycle.

    `see` takes a field from the surface to the window, `gather` a rate from the window to the
    surface: its transpose, weighted as the average is. Fields on a body's surface have shape
    (rows, ny).

    Examples
    --------
    >>> class Tooth(tribo.Stationary):
    ...     def average(self, rate):
    ...         return 0.1 * rate  # one of ten teeth, each in contact in its turn
    >>> Tooth(tribo.Grid("1 mm", (2, 1))).average(np.array([[1.0], [2.0]])).tolist()
    [[0.1], [0.2]]
    """

    swept: bool = False
    """Whether the body's points pass through the contact."""

    shape_stays: bool = True
    """Whether the body's initial shape stands still in the contact frame: for a stationary body,
    and for a body that turns about an axis across the sliding direction. The surface of a body
    whose shape moves must not vary along x."""

    starts: Sequence[int] | None = None
    """The row of the body's own surface at which the window begins, at each position of the cycle;
    None where the body has only the rows of the window, or one for all. In a window that repeats,
    rows are counted round."""

    across: Sequence[int] | None = None
    """The column at which the window begins, as `starts` for rows; None if it is the first. A body
    has the columns of the window, which are counted round."""

    rows: int
    """Cells along x on the body's own surface; 1 where all points of a track wear alike."""

    @property
    def averaged(self) -> bool:
        """Whether its points are averaged along a track and have no place along x."""
        return self.swept and self.starts is None

    def first_cell(self, position: int) -> Cell:
        """Return the cell of the body's own surface at which the window begins at a position."""
        row = 0 if self.starts is None else self.starts[position]
        return row, 0 if self.across is None else self.across[position]

    def track(self, window: Grid) -> float:
        """Return the mean length of the track of its points, in m; 0 if they are stationary."""
        if not self.swept:
            return 0.0
        # What one metre of depth all along it takes, over the breadth of the window.
        return self.volume(np.ones((1, window.cells[1]))) / window.size[1]

    def own_grid(self, window: Grid) -> Grid:
        """Return the grid of the body's first surface: the window, or its rows along the path."""
        if self.starts is None:
            return window
        size = self.rows * window.spacing[0], window.size[1]
        return Grid(size=size, cells=(self.rows, window.cells[1]))

    def see(self, field: Array, position: int) -> Array:
        """Return the part in the window of a field on the body's own surface, at a position.

        Shape (nx, ny), or (1, ny) for a field that is uniform along a track.
        """
        return field

    def lay(self, field: Array, position: int) -> Array:
        """Return a field of the window on the body's own surface, at a position.

        Fields of an averaged track stay in the window.
        """
        return field

    def gather(
        self, rate: Array, position: int, part: float = 1.0, total: Array | None = None
    ) -> Array:
        """Return the sum on the surface of a rate in the window over a part of the path.

        With a `total`, on the surface, it is added to that: in place if the body has rows of its
        own.
        """
        mean = part * self.average(rate)
        return mean if total is None else total + mean

    def average(self, rate: Array) -> Array:
        """Return the mean rate at each point of the body per metre of sliding, on its surface.

        It is the mean over a whole motion of a rate in the contact frame, shape (nx, ny): `rate`
        itself, unless overridden for an averaged track.
        """
        return rate

    def envelope(self, field: Array) -> Array:
        """Return the largest value of a field that each point of the body meets, on its surface.

        The field lies there, and is the answer; for an averaged track, it is in the contact frame.
        """
        return field

    @abstractmethod
    def volume(self, depth: Array) -> float:
        """Return the volume of a depth field on the body's whole surface, in m³."""

    def compliance(self, derivative: Array, pressure: Array) -> WearCompliance | None:
        """Return the wear per metre of sliding as a compliance, or None.

        `derivative` is the derivative of the depth per metre at `pressure` (Pa), in 1/Pa, both of
        shape (nx, ny). The implicit step corrects the approximation to its exact rate; None leaves
        the step to plain iteration.
        """
        return None


class Stationary(Exposure):
    """The same material points stay in contact, on all cells of `grid`, the window.

    Examples
    --------
    >>> ball = tribo.Stationary(tribo.Grid("1 mm", 8))
    >>> round(ball.volume(np.full((8, 8), 1e-6)) * 1e9, 6)  # mm³: 1 µm over 1 mm²
    0.001
    """

    def __init__(self, grid: Grid) -> None:
        self._grid = grid
        self.rows = grid.cells[0]
        self._cell_area = grid.cell_area

    def volume(self, depth: Array) -> float:
        """Return the integral of `depth` over the body's rows, in m³."""
        return float(np.sum(depth)) * self._cell_area

    def compliance(self, derivative: Array, pressure: Array) -> WearCompliance:
        """Return the derivative as a local compliance."""
        return WearCompliance(derivative, np.zeros(derivative.shape[1]))


class Track(Exposure):
    """Points pass through the contact along x, all over a track of given length.

    The mean over the track is (J r)(y) = (Δx/ℓ) Σₓ r(x, y), whatever the window: equations 4 and 5
    of Andersson, Almqvist & Larsson (2010) with N = L. Fields on the body have shape (1, ny).

    Valid on a closed track. Where the contact reverses inside the track it is an approximation, too
    deep at mid-track (see `tribo.Reciprocating`).

    Parameters
    ----------
    grid : Grid
        The window.
    length : float or ndarray, shape (ny,)
        Track length ℓ, in m: the stroke, or the circumference, of each row where they differ.
    shape_stays : bool, optional
        Whether the body turns, so that its shape stands still while its
        points pass: the disks of a twin-disk tester.

    Examples
    --------
    >>> disk = tribo.Track(tribo.Grid("1 mm", 8), length=0.1)
    >>> rate = disk.average(np.full((8, 8), 1e-6))
    >>> round(float(rate[0, 0]) * 1e9, 6)  # nm a metre: 1 mm of contact on 100 mm of track
    10.0
    """

    swept = True
    rows = 1

    def __init__(self, grid: Grid, length: float | Array, *, shape_stays: bool = False) -> None:
        self._ny = grid.cells[1]
        self._dx, self._dy = grid.spacing
        self.length = length
        self.shape_stays = shape_stays

    def average(self, rate: Array) -> Array:
        """Return the track average, shape (1, ny)."""
        line = np.sum(rate, axis=0, keepdims=True)
        return np.asarray(line * (self._dx / self.length))

    def envelope(self, field: Array) -> Array:
        """Return the maximum along the track, shape (1, ny)."""
        return np.asarray(np.max(field, axis=0, keepdims=True))

    def volume(self, depth: Array) -> float:
        """Return the area of the track's cross-section times its length, row by row, in m³."""
        section = np.max(np.broadcast_to(depth, (depth.shape[0], self._ny)), axis=0)
        return float(np.sum(section * self.length)) * self._dy

    def compliance(self, derivative: Array, pressure: Array) -> WearCompliance:
        """Return the load-weighted mean derivative of each row as a swept compliance."""
        line_load = np.sum(pressure, axis=0)
        loaded = line_load > 0
        weighted = np.sum(derivative * pressure, axis=0) / np.where(loaded, line_load, 1.0)
        # A row that is yet to be touched has the derivative that its law gives nearby.
        mean = np.where(loaded, weighted, np.max(derivative, axis=0))
        return WearCompliance(np.zeros_like(derivative), mean / self.length)


class Passing(Stationary):
    """Points pass through the contact, which is solved at positions along their path.

    The body has rows of its own, which include the window at every position. Its wear is r(x) =
    Σₘ ωₘ Tₘᵀ r(pₘ), with ωₘ the share of the path at position m and Tₘᵀ mapping the window to the
    body's place there. With all pₘ equal it is the average of `Track` at mid-stroke. On its own
    rows its points stay, so that averages, envelopes and volumes are as in `Stationary`.

    In a window that repeats, the body repeats with it: it has the rows of the window, and a row
    that leaves the window enters again at the other end. So do columns of a body that moves across.

    Parameters
    ----------
    grid : Grid
        The window.
    starts : sequence of int
        The row of the body at which the window begins, at each position.
    length : float
        Length of the path, in m.
    across : sequence of int, optional
        The column at which the window begins, at each position.

    Examples
    --------
    >>> disk = tribo.Passing(tribo.Grid("1 mm", (2, 1)), starts=[0, 1, 2], length=1e-3)
    >>> wear = sum(disk.gather(np.full((2, 1), 3e-9), at, part=1 / 3) for at in range(3))
    >>> (wear[:, 0] * 1e9).round(6).tolist()  # nm a metre: most in the middle
    [1.0, 2.0, 2.0, 1.0]
    """

    swept = True
    starts: Sequence[int]

    def __init__(
        self,
        grid: Grid,
        starts: Sequence[int],
        length: float,
        across: Sequence[int] | None = None,
    ) -> None:
        super().__init__(grid)
        self.starts = tuple(starts)
        self.across = None if across is None else tuple(across)
        self._cells = [*zip(starts, across or [0] * len(starts), strict=True)]
        # The middle one lies midway.
        self.rows = grid.period or grid.cells[0] + max(*starts, 2 * starts[len(starts) // 2])
        self._length = length if grid.period is None else min(length, grid.size[0])

    def track(self, window: Grid) -> float:
        """Return the length of the path, in m, or of the window that repeats if that is less."""
        return self._length

    def see(self, field: Array, position: int) -> Array:
        """Return the rows of the window, from the start of the position on."""
        count = self._grid.cells[0], field.shape[1]
        seen: Array = field[region(field, self._cells[position], count)]
        return seen

    def lay(self, field: Array, position: int) -> Array:
        """Return the field on the body's rows, from the start of the position on."""
        own = np.zeros((self.rows, *field.shape[1:]))
        own[region(own, self._cells[position], field.shape)] += field
        return own

    def gather(
        self, rate: Array, position: int, part: float = 1.0, total: Array | None = None
    ) -> Array:
        """Return the rate's part on the body's rows, added to `total` in place."""
        if total is None:
            return self.lay(part * rate, position)
        total[region(total, self._cells[position], rate.shape)] += part * rate
        return total

    def compliance(self, derivative: Array, pressure: Array) -> WearCompliance:
        """Return the compliance of the average, which takes all positions to change alike.

        In the middle of a contact longer than the path, a point meets pressure all along it.
        """
        contact = self._grid.spacing[0] * np.count_nonzero(pressure, axis=0)
        track = Track(self._grid, np.maximum(contact, self._length))
        return track.compliance(derivative, pressure)


def one_swept_body(
    grid: Grid, bodies: Sequence[str], swept: str | None, exposure: Exposure
) -> dict[str, Exposure]:
    """Return `exposure` for the swept body, the last if it has no name, `Stationary` for others.

    `CaseError` if there is no body of that name.
    """
    name = bodies[-1] if swept is None else swept
    if name not in bodies:
        raise CaseError(unknown("body", name, bodies), "kinematics.swept")
    return {b: exposure if b == name else Stationary(grid) for b in bodies}
