"""A result as a notebook shows it."""

from __future__ import annotations

from base64 import b64encode
from html import escape
from io import BytesIO

from tribo.cli.lab_report import status_words
from tribo.lab.report import lab_report
from tribo.lab.tables import saves_table, wear_table
from tribo.plotting.figures import result_picture
from tribo.plotting.picture import NothingToDraw
from tribo.result.read import Result

TALLEST = 260
"""Height of the picture and most height of the tables, in px; both fit below 600."""


def html(result: Result) -> str:
    """Return the saves, the wear and a picture of the pressure, as HTML.

    The picture has a white ground, so that it reads on a dark page; the tables have the page's
    colours.
    """
    lab = lab_report(result)
    tables = saves_table(result), wear_table(result, lab.bodies)
    shown = "".join(table._repr_html_() for table in tables)
    notes = "".join(f"<p>{escape(note)}</p>" for note in filter(None, [status_words(result)]))
    try:
        picture = BytesIO()
        result_picture(result, "pressure_sections").savefig(
            picture, format="png", facecolor="white"
        )
        data = b64encode(picture.getvalue()).decode()
        notes += f'<img style="height:{TALLEST}px" src="data:image/png;base64,{data}">'
    except NothingToDraw as uniform:
        notes += f"<p>{escape(str(uniform))}</p>"
    return f'<div style="max-height:{TALLEST}px;overflow:auto">{shown}</div>{notes}'
