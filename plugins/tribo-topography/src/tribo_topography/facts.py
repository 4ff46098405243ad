"""What a measured surface is taken to be, to be looked at and to be checked."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from tribo import CaseError

from tribo_topography.config import MeasuredFile
from tribo_topography.form import detrended
from tribo_topography.read import StoredMap, read

# In m, from the map of an AFM to the map of a large profilometer.
WIDEST, NARROWEST = 0.1, 1e-6
_FORM = {"none": "", "mean": "", "tilt": ", tilt removed", "curvature": ", form removed"}


@dataclass(frozen=True)
class Facts:
    """The scale of a height map; ``str`` gives it in one line.

    Parameters
    ----------
    path : Path
        The file.
    format, channel : str
        What it was read as, and which map of it.
    channels : tuple of str
        All maps in the file.
    pixels : tuple of int
        Along the file's x and y.
    size : tuple of float
        Edge lengths along the file's x and y, in m.
    range : float
        Highest less lowest height that was measured, after detrending, in m.
    sq : float
        Root mean square of the heights about their mean, after detrending, in m.
    missing : float
        Part of the pixels that are missing.
    detrend : str
        What was taken off.
    sha256 : str
        Of the file.

    Examples
    --------
    >>> from tribo_topography import describe
    >>> waves = describe("plugins/tribo-topography/tests/data/waves.asc")
    >>> waves.pixels, f"Sq {1e6 * waves.sq:.2f} µm"
    ((30, 30), 'Sq 0.54 µm')
    """

    path: Path
    format: str
    channel: str
    channels: tuple[str, ...]
    pixels: tuple[int, int]
    size: tuple[float, float]
    range: float
    sq: float
    missing: float
    detrend: str
    sha256: str

    def __str__(self) -> str:
        """Return the facts in one line, in the units of a lab."""
        missing = ", {missing} missing" if self.missing else ""
        words = "{file} ({read as}): {pixels} pixels on {size}, heights {heights}, Sq {Sq}"
        return (words + missing).format(**self.stated())

    def stated(self) -> dict[str, str]:
        """Return the facts one by one, in the units of a lab."""
        stated = {
            "file": self.path.name,
            "read as": f"{self.format}, {self.channel!r}",
            "pixels": f"{self.pixels[0]} × {self.pixels[1]}",
            "size": _shown(self.size),
            "heights": f"over {1e6 * self.range:.4g} µm{_FORM[self.detrend]}",
            "Sq": f"{1e6 * self.sq:.4g} µm",
        }
        if self.missing:
            stated["missing"] = f"{100 * self.missing:.2g} %"
        return {**stated, "sha256": self.sha256}


def describe(what: MeasuredFile | str | Path) -> Facts:
    """Return the scale of a file as tribo takes it.

    Parameters
    ----------
    what : MeasuredFile or path
        The surface of a case, or a file that states its own scale.

    Returns
    -------
    Facts
        Its pixels, size and roughness.

    Raises
    ------
    CaseError
        If it cannot be read.

    Examples
    --------
    >>> from tribo_topography import describe
    >>> waves = describe("plugins/tribo-topography/tests/data/waves.asc")
    >>> waves.stated()["heights"]
    'over 2.568 µm, tilt removed'
    """
    config = what if isinstance(what, MeasuredFile) else MeasuredFile(path=Path(what))
    return facts(read(config), config)


def facts(found: StoredMap, config: MeasuredFile) -> Facts:
    """Return the scale of a map; its form is taken off here."""
    heights = detrended(found.heights, config.detrend)
    nx, ny = heights.shape
    return Facts(
        path=config.path,
        format=found.format,
        channel=found.channel,
        channels=found.channels,
        pixels=(nx, ny),
        size=found.size,
        range=float(np.nanmax(heights) - np.nanmin(heights)),
        sq=float(np.nanstd(heights)),
        missing=float(np.mean(np.isnan(heights))),
        detrend=config.detrend,
        sha256=found.sha256,
    )


def check(found: Facts, config: MeasuredFile) -> None:
    """Raise `CaseError` where the scale is not the expected one, or absurd.

    Readers of the same file have been seen to disagree by a factor of 8 in
    height and 10⁶ in width.
    """
    given = _shown(found.size)
    if config.expect_size is not None:
        for size, expected in zip(found.size, config.expect_size, strict=True):
            if abs(size - expected) > config.expect_within * expected:
                raise CaseError(
                    f"{found.path} is {given}, but expect_size says {_shown(config.expect_size)}. "
                    "Put right whichever is wrong: size, or expect_size"
                )
    elif not NARROWEST <= min(found.size) <= max(found.size) <= WIDEST:
        raise CaseError(
            f"{found.path} would be {given}, which is unlikely; give size if that is wrong, or "
            "expect_size if it is right"
        )
    span = f"{1e6 * found.range:.4g} µm"
    if config.expect_range is not None:
        if abs(found.range - config.expect_range) > config.expect_within * config.expect_range:
            raise CaseError(
                f"the heights of {found.path} range over {span}, but expect_range says "
                f"{1e6 * config.expect_range:.4g} µm. Put right whichever is wrong: height_scale, "
                "detrend, or expect_range"
            )
    elif found.range > min(found.size):
        raise CaseError(
            f"the heights of {found.path} would range over {span} on {given}, which is unlikely; "
            "give height_scale or size if that is wrong, or expect_range if it is right"
        )


def _shown(size: tuple[float, float]) -> str:
    return f"{1e3 * size[0]:.4g} × {1e3 * size[1]:.4g} mm"
