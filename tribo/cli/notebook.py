"""A result as a notebook shows it."""

from __future__ import annotations

from base64 import b64encode
from html import escape
from io import BytesIO

from tribo.cli.lab_report import report_blocks, status_words
from tribo.core.data_table import DataTable
from tribo.lab.report import lab_report
from tribo.plotting.pressure import pressure_sections
from tribo.result.read import Result


def html(result: Result) -> str:
    """Return the lab report of a result and a picture of its pressure, as HTML."""
    lab = lab_report(result)
    notes = [status_words(result), *(f"Note: {finding}" for finding in lab.findings)]
    shown = "".join(
        block._repr_html_() if isinstance(block, DataTable) else f"<p>{escape(block)}</p>"
        for block in [*report_blocks(result, lab), *filter(None, notes)]
    )
    picture = BytesIO()
    pressure_sections(result).savefig(picture, format="png")
    data = b64encode(picture.getvalue()).decode()
    return f'{shown}<img src="data:image/png;base64,{data}">'
