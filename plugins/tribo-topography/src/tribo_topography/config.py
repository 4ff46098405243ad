"""What a case says of a measured surface's file."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator
from tribo import Quantity, Table

Length = Annotated[float, Quantity("m")]
PositiveLength = Annotated[float, Quantity("m", above=0)]


class MeasuredFile(Table):
    """A height map from an instrument's file: where it is and how to take it.

    Examples
    --------
    >>> from tribo_topography import MeasuredFile, describe
    >>> waves = "plugins/tribo-topography/tests/data/waves.asc"
    >>> round(1e6 * describe(MeasuredFile(path=waves, height_scale=2)).range, 2)  # in µm
    5.14
    """

    path: Path
    """The file; a relative path starts at the current directory."""

    format: str | None = None
    """SurfaceTopography's name of the file format, as 'opd', 'x3p', 'sur', 'asc' or 'npy'; found
    out from the contents if left out."""

    channel: int | str | None = None
    """Name or number, from 0, of the map in the file; its default map if left out."""

    size: tuple[PositiveLength, PositiveLength] | None = None
    """Edge lengths of the measured area along the file's x and y; those in the file if left out.
    Replaces what the file says."""

    unit: PositiveLength | None = None
    """What a height of 1 in the file means, for a file that states no unit, as '1 um'."""

    height_scale: Annotated[float, Quantity("1")] = 1.0
    """Factor on the heights, to put a wrong scale right; -1 turns a replica round."""

    detrend: Literal["none", "mean", "tilt", "curvature"] = "tilt"
    """The form that is taken off by least squares over the whole area: nothing, the mean, a plane,
    or a paraboloid. Use 'none' or 'mean' where the shape of the body is in the file."""

    fill: Literal["error", "interpolate"] = "error"
    """What becomes of missing pixels: an error, or values interpolated from their neighbours."""

    max_missing: Annotated[float, Quantity("1", at_least=0, at_most=0.9)] = 0.1
    """Largest part of the pixels that may be missing where they are interpolated."""

    mirror: bool = False
    """Whether y is turned round, before `rotate`: the files of both bodies are seen from outside,
    but in the contact frame one of the two is seen from its inside."""

    rotate: Literal[0, 90, 180, 270] = 0
    """Degrees by which the map is turned anticlockwise, to bring the sliding direction to x."""

    centre: tuple[Length, Length] = (0.0, 0.0)
    """Where the window's centre lies in the turned map, along x and y from the map's middle."""

    expect_size: tuple[PositiveLength, PositiveLength] | None = None
    """The size that the measured area should have along the file's x and y; another is an error."""

    expect_range: Annotated[float, Quantity("m", at_least=0)] | None = None
    """The highest minus the lowest height that is expected after `detrend`; another is an error."""

    expect_within: Annotated[float, Quantity("1", above=0, at_most=0.5)] = 0.02
    """Relative difference from the expected size and range that is still accepted."""

    sha256: Annotated[str, Field(pattern=r"^[0-9a-fA-F]{64}$")] | None = None
    """SHA-256 of the file; a file with another one is an error."""

    @model_validator(mode="after")
    def _scaled(self) -> Self:
        if self.height_scale == 0:
            raise ValueError("height_scale is 0, which would leave no heights; leave it out")
        return self
