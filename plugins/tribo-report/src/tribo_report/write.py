"""Write a report to hand on."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tribo import CaseError, Comparison, Result, Sweep, compare
from tribo.kernel_api import check_output

from tribo_report.comparison import comparison_page
from tribo_report.page import write_page
from tribo_report.result import result_page
from tribo_report.sweep import RUNS, sweep_page

if TYPE_CHECKING:
    from tribo_inverse import Calibration

    What = Result | Comparison | Sweep | Calibration | str | Path | Sequence[str | Path]


def write_report(
    what: What,
    path: str | Path,
    *,
    verified: str | Path | None = None,
) -> Path:
    """Write a report to hand on: one HTML file under 4 MB that opens offline in any browser.

    Parameters
    ----------
    what : Result, Comparison, Sweep, Calibration, str, Path or sequence of str or Path
        A result or its file; a comparison, the files of several results, or
        a folder of them, as that of ``tribo compare``; a sweep or its folder; a
        calibration, or what ``tribo calibrate --json`` printed, in a file that ends
        in ``.json``. Results are compared with the first, of a folder in the order
        of the names.
    path : str or Path
        The file to write; what is there is replaced.
    verified : str or Path, optional
        What ``tribo verify CASE --json`` printed of the same case: the report
        of a result then states uncertainties.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    CaseError
        If there is no such result, or `verified` is of another
        case; or there is no such folder.
    OutputError
        If the file cannot be written.

    Examples
    --------
    >>> import tribo_report
    >>> tribo_report.write_report("my.h5", "report.html")  # doctest: +SKIP
    >>> tribo_report.write_report(["winkler.h5", "dcfft.h5"], "report.html")  # doctest: +SKIP
    """
    path = Path(path)
    check_output(path)
    write_page(_page(what, None if verified is None else Path(verified)), path)
    return path


def _page(what: What, verified: Path | None) -> str:
    if isinstance(what, str | Path) and Path(what).suffix == ".json":
        if verified is not None:
            raise _not_one_result()
        return str(_calibrations().calibration_file_page(Path(what)))
    found = _found(what) if isinstance(what, str | Path) else what
    if isinstance(found, Result):
        return result_page(found, verified)
    if isinstance(found, Sequence) and len(found) == 1:
        with Result.open(found[0]) as result:
            return result_page(result, verified)
    if verified is not None:
        raise _not_one_result()
    if isinstance(found, Sweep):
        return sweep_page(found.folder)
    if isinstance(found, Path):
        return sweep_page(found)
    if isinstance(found, Comparison):
        return comparison_page(found)
    if not isinstance(found, Sequence):
        return str(_calibrations().calibration_page(found, "Calibration"))
    with compare(found) as comparison:
        return comparison_page(comparison)


def _calibrations() -> Any:
    """Return the pages of calibrations, which need tribo-inverse."""
    try:
        return import_module("tribo_report.calibration")
    except ModuleNotFoundError as error:
        raise CaseError(
            f"the report of a calibration needs {error.name}: pip install ./plugins/tribo-inverse"
        ) from error


def _not_one_result() -> CaseError:
    return CaseError("a study of one case goes with one result", "--verified")


def _found(what: str | Path) -> Path | list[Path]:
    """Return what a path stands for: the folder of a sweep, or result files."""
    place = Path(what)
    if not place.is_dir():
        return [place]
    if (place / RUNS).exists():
        return place
    results = sorted(place.glob("*.h5"))
    if not results:
        raise CaseError(f"{place} holds no result file (.h5)")
    return results
