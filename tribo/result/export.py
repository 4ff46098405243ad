"""Write tables of a result as CSV or for Excel."""

from __future__ import annotations

from collections.abc import Mapping
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.writing import make_folder, write_file


def write_tables(tables: Mapping[str, Any], folder: Path, form: str = "csv") -> list[Path]:
    """Write tables as CSV files or, where `form` is ``"xlsx"``, as the sheets of an Excel file."""
    # Slow to import, and needed here only.
    import pandas as pd

    frames = {name: pd.DataFrame(table, dtype=float) for name, table in tables.items()}
    make_folder(folder)
    if form == "csv":
        paths = [folder / f"{name}.csv" for name in frames]
        for path, frame in zip(paths, frames.values(), strict=True):
            write_file(path, frame.to_csv(index=False, na_rep="nan", lineterminator="\r\n"))
        return paths
    if max(map(len, frames.values())) >= 2**20:
        raise CaseError("a sheet of Excel has 2²⁰ rows at most; export CSV files", "--format")
    book = BytesIO()
    try:
        with pd.ExcelWriter(book, engine="openpyxl") as writer:
            for name, frame in frames.items():
                frame.to_excel(writer, sheet_name=name, index=False)
    except ImportError:
        raise CaseError("xlsx needs openpyxl: pip install openpyxl", "--format") from None
    write_file(folder / "tables.xlsx", book.getvalue())
    return [folder / "tables.xlsx"]


def profile(field: Array, axis: int) -> Array:
    """Return the mean of the middle one or two lines of `field` along `axis`."""
    across = 1 - axis
    n = field.shape[across]
    middle = np.take(field, range((n - 1) // 2, n // 2 + 1), axis=across)
    return np.asarray(np.mean(middle, axis=across))
