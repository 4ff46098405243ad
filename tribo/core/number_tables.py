"""Tables of numbers in files."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tribo.core.arrays import Array

MOST_PIXELS = 2**26
"""Numbers of the largest table that is read, as a map of 8192²: 0.5 GiB, of which tribo makes a few
copies."""


def read_numbers(file: Path) -> Array:
    """Return the numbers of a CSV file, with or without a header, or of a .npy file.

    ValueError if there is no such file, or something else in it; the message says so.
    """
    numbers = table_of_numbers(file)
    bad = np.argwhere(~np.isfinite(numbers))
    if len(bad):
        raise ValueError(
            f"{len(bad)} of the {numbers.size} values of {file} are missing or infinite, the first "
            f"at {tuple((bad[0] + 1).tolist())}, counted from 1; put finite numbers there"
        )
    return numbers


def read_pairs(file: Path, what: str) -> Array:
    """Return the numbers of a file, shape (rows, 2); `what` names its columns in the message."""
    rows = read_numbers(file)
    if rows.ndim != 2 or rows.shape[1] != 2:
        raise ValueError(
            f"{file} must have two columns of numbers, {what}, separated by commas and below one "
            f"header at most, but has the shape {rows.shape}"
        )
    return rows


def check_file(file: Path) -> None:
    """Raise ValueError if there is no such file to read."""
    if not file.is_file():
        if file.is_dir():
            raise ValueError(f"{file} is a folder; give a file in it")
        where = "" if file.is_absolute() else f" in {Path.cwd()}, where tribo was started"
        raise ValueError(f"there is no file {file}{where}; put it there, or give its full path")


def table_of_numbers(file: Path) -> Array:
    """Return the numbers of a file as `read_numbers` does, NaN where some are missing."""
    check_file(file)
    if file.stat().st_size == 0:
        raise ValueError(f"{file} is empty")
    try:
        if file.suffix == ".npy":
            numbers: NDArray[Any] = np.lib.format.open_memmap(file, mode="r")
            check_pixels(numbers.size)
            # What is mapped would change with the file.
            numbers = np.array(numbers)
        else:
            with file.open(encoding="utf-8-sig") as lines:
                numbers = _table_of_text(lines)
    except (ValueError, OSError, LookupError, RuntimeError) as error:
        other = any(words in str(error) for words in ("magic string", "Python objects", "codec"))
        reason = "it is no NumPy array and no text" if other else " ".join(str(error).split())
        raise ValueError(f"{file} cannot be read as a table of numbers: {reason}") from None
    if numbers.dtype.kind not in "fiu":
        raise ValueError(f"{file} has values of type {numbers.dtype}; save real numbers, as floats")
    return np.asarray(numbers, dtype=np.float64)


def check_pixels(count: int) -> None:
    """Raise ValueError if a table, or a map, has too many numbers to be read."""
    if count > MOST_PIXELS:
        raise ValueError(
            f"it has {count:,} numbers, and at most {MOST_PIXELS:,} are read; take a part of it, "
            "or fewer pixels"
        )


def _table_of_text(lines: Iterable[str]) -> Array:
    """Return the numbers of a CSV text, below one line of words at most; NaN where missing."""
    rows: list[Array] = []
    headed = False
    for place, line in enumerate(lines, 1):
        cells = [cell.strip() for cell in line.partition("#")[0].split(",")]
        wrong = [cell for cell in cells if not _is_number(cell)]
        if cells == [""]:
            continue
        if wrong == cells and not rows and not headed:
            headed = True
            continue
        if wrong or (rows and len(cells) != len(rows[0])):
            found = f"{wrong[0][:40]!r}, which is no number" if wrong else f"{len(cells)} values"
            raise ValueError(
                f"line {place} has {found}; give as many numbers in each line, separated by "
                "commas, with decimal points, as 1.5, leave missing ones empty, and keep one "
                "header line at most"
            )
        rows.append(np.array([float(cell or "nan") for cell in cells]))
        check_pixels(len(rows) * len(cells))
    if not rows:
        raise ValueError("it has no line of numbers, separated by commas, with decimal points")
    return np.array(rows)


def _is_number(cell: str) -> bool:
    try:
        float(cell or "nan")
    except ValueError:
        return False
    return True
