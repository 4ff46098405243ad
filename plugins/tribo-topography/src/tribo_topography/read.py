"""Read a height map from an instrument's file, through SurfaceTopography."""

from __future__ import annotations

import hashlib
import warnings
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

import h5py
import numpy as np
from tribo import Array, CaseError
from tribo.kernel_api import check_file, check_pixels, contained

from tribo_topography.config import MeasuredFile

MAX_BYTES = 2**30
"""Size of the largest file that is read, also when unpacked: 11,000² heights in double
precision."""


@dataclass(frozen=True)
class StoredMap:
    """A height map as its file and the configuration give it.

    Parameters
    ----------
    heights : ndarray, shape (nx, ny)
        In m, along the file's x and y; NaN where missing.
    size : tuple of float
        Edge lengths along x and y, in m; a pixel is size / shape.
    format, channel : str
        What it was read as, and which map of the file it is.
    channels : tuple of str
        All maps in the file.
    sha256 : str
        Of the file.
    """

    heights: Array
    size: tuple[float, float]
    format: str
    channel: str
    channels: tuple[str, ...]
    sha256: str


def read(config: MeasuredFile) -> StoredMap:
    """Read the map that `config` names, without changing its form.

    Raises
    ------
    CaseError
        If the file is missing, too large, not understood, not the one with
        the given checksum, or does not state a scale that the case does not
        give either.
    """
    path = config.path
    sha256 = _checked_file(path, config.sha256)
    # Opened here, for some readers do not close what they open.
    with path.open("rb") as file, _third_party(path), _open(path, file, config.format) as reader:
        channels = reader.channels
        index = _channel(path, reader, config.channel)
        channel = channels[index]
        sizes = _checked_channel(path, channel, config)
        # Readers refuse a size where the file has one, and want one where it has not.
        given = {} if channel.physical_sizes is not None else {"physical_sizes": (1.0, 1.0)}
        topography = reader.topography(channel_index=index, **given)
        heights = np.ma.filled(np.ma.asarray(topography.heights(), np.float64), np.nan)
        metre = _metre(path, topography.unit, config)
    heights = np.where(np.isfinite(heights), heights * (metre * config.height_scale), np.nan)
    if not np.isfinite(heights).any():
        raise CaseError(f"{path} holds no height at all: every pixel is missing")
    size = config.size or (metre * sizes[0], metre * sizes[1])
    names = tuple(str(each.name) for each in channels)
    return StoredMap(heights, size, str(reader.format()), names[index], names, sha256)


@contextmanager
def _third_party(path: Path) -> Iterator[None]:
    """Silence warnings of the readers, and make one line of what they raise."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            yield
        except CaseError:
            raise
        except ImportError as error:
            raise CaseError(
                f"reading {path} needs SurfaceTopography: pip install SurfaceTopography ({error})"
            ) from error
        except Exception as error:
            raise CaseError(f"{path} cannot be read: {_said(error)}") from error


def _checked_file(path: Path, expected: str | None) -> str:
    try:
        check_file(path)
    except ValueError as error:
        raise CaseError(str(error)) from None
    if h5py.is_hdf5(path):
        with _third_party(path), h5py.File(path) as opened:
            for _ in contained(opened):
                pass
    size = path.stat().st_size
    # Not a zip file, or a broken one, is for the readers to tell.
    with suppress(zipfile.BadZipFile), zipfile.ZipFile(path) as archive:
        size = max(size, sum(member.file_size for member in archive.infolist()))
    if size > MAX_BYTES:
        raise CaseError(
            f"{path} has {size / 2**20:.0f} MiB; at most {MAX_BYTES / 2**20:.0f} MiB are read. "
            "Export the part of it that is needed"
        )
    with path.open("rb") as file:
        sha256 = hashlib.file_digest(file, "sha256").hexdigest()
    if expected is not None and sha256 != expected.lower():
        raise CaseError(
            f"{path} is not the file that is meant: its SHA-256 is {sha256}, not {expected.lower()}"
        )
    return sha256


def _open(path: Path, file: BinaryIO, name: str | None) -> Any:
    from SurfaceTopography.IO import (
        CannotDetectFileFormat,
        lookup_reader_by_format,
        open_topography,
        readers,
    )

    if name is not None and name not in lookup_reader_by_format:
        known = ", ".join(sorted(lookup_reader_by_format))
        raise CaseError(f"no file format is called {name!r}; there are {known}")
    try:
        reader = open_topography(file, format=name)
    except CannotDetectFileFormat:
        raise CaseError(
            f"{path} is broken, or in no format that is known; export it again, as .x3p"
        ) from None
    except Exception as error:
        raise CaseError(f"{path} cannot be read as {name!r}: {_said(error)}") from error
    suffix, found = path.suffix.lstrip(".").lower(), reader.format()
    usual = [each.format() for each in readers if suffix in (each.file_extensions() or ())]
    if name is None and usual and found not in usual:
        raise CaseError(
            f"{path} is named as {usual[0]!r}, but looks like {found!r} inside; if it is that, "
            f"rename it, or set format = {found!r} in a case"
        )
    return reader


def _channel(path: Path, reader: Any, wanted: int | str | None) -> int:
    names = [str(channel.name) for channel in reader.channels]
    if wanted is None:
        return int(reader.default_channel.index)
    if isinstance(wanted, int) and 0 <= wanted < len(names):
        return wanted
    if isinstance(wanted, str) and names.count(wanted) == 1:
        return names.index(wanted)
    listed = ", ".join(f"{number} {name!r}" for number, name in enumerate(names))
    raise CaseError(f"{path} has no channel {wanted!r}, or several; its channels are {listed}")


def _checked_channel(path: Path, channel: Any, config: MeasuredFile) -> tuple[float, float]:
    """Return the sizes in the file's unit; of no meaning where the case gives them."""
    if channel.dim != 2 or channel.is_uniform is False:
        raise CaseError(f"{path}, channel {channel.name!r}, is not a map on a regular grid")
    nx, ny = channel.nb_grid_pts
    try:
        check_pixels(nx * ny)
    except ValueError as error:
        raise CaseError(f"{path}, {nx} × {ny} pixels: {error}") from None
    if min(nx, ny) < 4:
        raise CaseError(f"{path} has {nx} × {ny} pixels; 4 × 4 are needed at least")
    if config.size is not None:
        return 1.0, 1.0
    if channel.physical_sizes is None:
        raise CaseError(
            f"{path} does not say how large the measured area is; export it as .x3p or, in a case, "
            'add size = ["1.24 mm", "0.94 mm"]'
        )
    sx, sy = channel.physical_sizes
    return float(sx), float(sy)


def _metre(path: Path, stated: str | None, config: MeasuredFile) -> float:
    """Return the file's unit, in m."""
    from SurfaceTopography.Support.UnitConversion import get_unit_conversion_factor

    if stated is None:
        if config.unit is None:
            raise CaseError(
                f"{path} states no unit for its heights; export it as .x3p or, in a case, add "
                "unit = '1 um'"
            )
        return config.unit
    if config.unit is not None:
        raise CaseError(
            f"{path} states its heights in {stated}; leave unit out (height_scale puts a wrong "
            "scale right)"
        )
    return float(get_unit_conversion_factor(stated, "m"))


def _said(error: Exception) -> str:
    text = " ".join(str(error).split())
    return (text[:157] + "…" if len(text) > 160 else text) or type(error).__name__
