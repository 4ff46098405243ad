"""Write a report to hand on."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
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
        A result or its file; a comparison, the files of several results, or a
        folder of them, as from ``tribo compare``; a sweep or its folder; a
        calibration, or the output of ``tribo calibrate --json`` in a file that ends
        in ``.json``. Results are compared with the first; a folder is in the order
        of the names.
    path : str or Path
        The file to write; an existing file is replaced.
    verified : str or Path, optional
        The output of ``tribo verify CASE --json`` for the same case: the report
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
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from tribo_report import write_report
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> result = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse).run()
    >>> with TemporaryDirectory() as folder:
    ...     write_report(result, Path(folder, "report.html")).stat().st_size < 4e6
    True
    """
    path = Path(path)
    check_output(path)
    write_page(_page(what, None if verified is None else Path(verified)), path)
    return path


def _page(what: What, verified: Path | None) -> str:
    with ExitStack() as opened:
        found = _opened(what, opened)
        if isinstance(found, Result):
            return result_page(found, verified)
        if verified is not None:
            raise CaseError("a study of one case goes with one result", "--verified")
        if isinstance(found, Comparison):
            return comparison_page(found)
        if not isinstance(found, Path):
            return str(_calibrations().calibration_page(found, "Calibration"))
        if found.suffix == ".json":
            return str(_calibrations().calibration_file_page(found))
        return sweep_page(found)


def _opened(what: What, opened: ExitStack) -> Result | Comparison | Calibration | Path:
    """Return the subject of the report; for a sweep and a printed calibration the path alone."""
    if isinstance(what, str | Path):
        place = Path(what)
        if place.suffix == ".json" or (place / RUNS).exists():
            return place
        what = sorted(place.glob("*.h5")) if place.is_dir() else [place]
        if not what:
            raise CaseError(f"{place} holds no result file (.h5)")
    if isinstance(what, Sequence):
        if len(what) == 1:
            return opened.enter_context(Result.open(what[0]))
        return opened.enter_context(compare(what))
    return what.folder if isinstance(what, Sweep) else what


def _calibrations() -> Any:
    """Return the pages of calibrations, which need tribo-inverse."""
    try:
        return import_module("tribo_report.calibration")
    except ModuleNotFoundError as error:
        raise CaseError(
            f"the report of a calibration needs {error.name}: pip install ./plugins/tribo-inverse"
        ) from error
