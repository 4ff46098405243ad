"""Write a report to hand on."""

from __future__ import annotations

from pathlib import Path

from tribo.report.page import write_page
from tribo.report.result import result_page
from tribo.result.read import Result


def write_report(
    what: Result | str | Path, path: str | Path, *, verified: str | Path | None = None
) -> Path:
    """Write a report of a result: one HTML file under 4 MB that opens offline in any browser.

    Parameters
    ----------
    what : Result, str or Path
        A result, or its file.
    path : str or Path
        The file to write; what is there is replaced.
    verified : str or Path, optional
        What ``tribo verify CASE --json`` printed of the same case: the report
        then states uncertainties.

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
    """
    study, to = None if verified is None else Path(verified), Path(path)
    if isinstance(what, Result):
        page = result_page(what, study)
    else:
        with Result.open(what) as result:
            page = result_page(result, study)
    write_page(page, to)
    return to
