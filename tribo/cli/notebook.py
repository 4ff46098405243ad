"""A result as a notebook shows it."""

from __future__ import annotations

from base64 import b64encode
from html import escape
from io import BytesIO, StringIO

from tribo.cli.console import Console
from tribo.cli.tables import print_report
from tribo.plotting.pressure import pressure_sections
from tribo.result.read import Result


def html(result: Result) -> str:
    """Return the lab table of a result and a picture of its pressure, as HTML."""
    table = StringIO()
    # Colours would be escape sequences, which a kernel asks for by FORCE_COLOR.
    print_report(result, Console(file=table, width=80, force_jupyter=False, color_system=None))
    picture = BytesIO()
    pressure_sections(result).savefig(picture, format="png")
    data = b64encode(picture.getvalue()).decode()
    return f'<pre>{escape(table.getvalue())}</pre><img src="data:image/png;base64,{data}">'
