"""Heights given as an array: from a NumPy or CSV file, or from Python."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import numpy as np
import scipy
from pydantic import Field, field_validator

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.grid import Grid, Length
from tribo.core.number_tables import read_numbers
from tribo.core.rounding import ROUND_OFF
from tribo.core.units import Quantity
from tribo.surfaces.relief import Laid
from tribo.surfaces.surface import Surface

Line = Annotated[tuple[Annotated[float, Quantity("m")], ...], Field(min_length=2)]


class HeightMap(Laid):
    """Heights at the centres of the cells of a rectangle about the origin, and lines in between.

    Examples
    --------
    >>> ramp = tribo.HeightMap(size=(1e-3, 1e-3), heights=[[0, 0], [1e-6, 1e-6]])
    >>> (ramp.height(tribo.Grid("1 mm", (4, 1)))[:, 0] * 1e6).round(2).tolist()  # µm
    [0.0, 0.25, 0.75, 1.0]
    """

    examples = (
        {
            "size": ["8 mm", "8 mm"],
            "heights": [[0, 1e-7, 0], [1e-7, 2e-7, 1e-7], [0, 1e-7, 0]],
        },
    )
    type = "array"
    size: tuple[Length, Length]
    """Edge lengths of the rectangle along x, the sliding direction, and y."""
    heights: Annotated[tuple[Line, ...], Field(min_length=2)]
    """Heights outward in m, a row for each x with a value for each y, or the name of a .npy or CSV
    file with them; a relative name starts at the current directory. From Python also an array."""

    @field_validator("heights", mode="before")
    @classmethod
    def _from_file(cls, value: Any) -> Any:
        if isinstance(value, str | Path):
            value = read_numbers(Path(value))
        return value.tolist() if isinstance(value, np.ndarray) else value

    @field_validator("heights")
    @classmethod
    def _rectangular(cls, heights: tuple[Line, ...]) -> tuple[Line, ...]:
        if len({len(line) for line in heights}) > 1:
            raise ValueError("the rows of heights are not all of one length")
        return heights

    def smoothed(self) -> Surface:
        """Return the surface itself: its heights may be all of its form."""
        return self

    def relief(self, grid: Grid) -> Array:
        """Return the heights between those given, on lines; the map must reach over the window."""
        sizes = zip(self.size, grid.size, strict=True)
        if any(own < asked * (1 - ROUND_OFF) for own, asked in sizes):
            raise CaseError(
                f"{_mm(self.size)} of heights do not reach over {_mm(grid.size)}, the window (and "
                "the path of a body that passes through it); give a larger map, or make grid.size "
                "smaller"
            )
        given = np.array(self.heights)
        places = [
            (axis * count / size + 0.5 * (count - 1))
            for axis, count, size in zip((grid.x, grid.y), given.shape, self.size, strict=True)
        ]
        at = np.meshgrid(*places, indexing="ij")
        # Half a cell of the map lies beyond its outermost centres.
        return np.asarray(scipy.ndimage.map_coordinates(given, at, order=1, mode="nearest"))


def _mm(size: tuple[float, float]) -> str:
    return f"{1e3 * size[0]:.4g} × {1e3 * size[1]:.4g} mm"
