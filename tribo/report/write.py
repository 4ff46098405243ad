"""Write a report to hand on."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from tribo.core.errors import CaseError
from tribo.report.comparison import comparison_page
from tribo.report.page import write_page
from tribo.report.result import result_page
from tribo.result.read import Result
from tribo.study.comparison import Comparison, compare


def write_report(
    what: Result | Comparison | str | Path | Sequence[str | Path],
    path: str | Path,
    *,
    verified: str | Path | None = None,
) -> Path:
    """Write a report to hand on: one HTML file under 4 MB that opens offline in any browser.

    Parameters
    ----------
    what : Result, Comparison, str, Path or sequence of str or Path
        A result or its file; or a comparison, the files of several results, or
        a folder of them, as that of ``tribo compare``. The first, of a folder in
        the order of the names, is what the others are compared with.
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
        If what a report needs is not installed (``pip install 'tribo[report]'``),
        there is no such result or it holds no save, or `verified` is of another
        case.
    OutputError
        If the file cannot be written.

    Examples
    --------
    >>> import tribo
    >>> tribo.write_report("my.h5", "report.html")  # doctest: +SKIP
    >>> tribo.write_report(["winkler.h5", "dcfft.h5"], "report.html")  # doctest: +SKIP
    """
    write_page(_page(what, None if verified is None else Path(verified)), Path(path))
    return Path(path)


def _page(
    what: Result | Comparison | str | Path | Sequence[str | Path], verified: Path | None
) -> str:
    if isinstance(what, Result):
        return result_page(what, verified)
    if isinstance(what, str | Path):
        place = Path(what)
        if not place.is_dir():
            with Result.open(place) as result:
                return result_page(result, verified)
        what = sorted(place.glob("*.h5"))
        if not what:
            raise CaseError(f"{place} holds no result file (.h5)")
    if verified is not None:
        raise CaseError("a study of one case says nothing of several results", "--verified")
    if isinstance(what, Comparison):
        return comparison_page(what)
    if len(what) == 1:
        return _page(what[0], verified)
    with compare(what) as comparison:
        return comparison_page(comparison)
