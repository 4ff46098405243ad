"""A report: one HTML file with all that it needs."""

from __future__ import annotations

import gzip
import json
from base64 import b64encode
from collections.abc import Mapping
from importlib.resources import files
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tribo import CaseError
from tribo.kernel_api import write_file

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.figure import Figure

LARGEST = 4_000_000
"""Most bytes of a report: mail programs take such a file."""
STILL_DPI = 130
"""Dots per inch: 435 pixels for a picture of one column."""
WIDE = 4.0
"""Width from which a picture takes a whole line, in inches."""


def render(template: str, *, data: Mapping[str, Any] | None = None, **values: Any) -> str:
    """Return a template of this package filled in, with styles, scripts and data inside.

    Without `data` there is nothing to draw, and Plotly is left out.
    """
    from jinja2 import Environment, PackageLoader, StrictUndefined
    from plotly.offline import get_plotlyjs

    environment = Environment(
        loader=PackageLoader("tribo_report", "files"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    own = files("tribo_report") / "files"
    return environment.get_template(template).render(
        style=(own / "report.css").read_text(encoding="utf-8"),
        script=(own / "report.js").read_text(encoding="utf-8"),
        plotly=packed(get_plotlyjs()) if data else "",
        data="" if data is None else packed(data),
        **values,
    )


def packed(what: str | Mapping[str, Any]) -> str:
    """Return text, or data as JSON, compressed; `report.js` unpacks it."""
    text = what if isinstance(what, str) else json.dumps(what, separators=(",", ":"))
    # No date, so that the same result gives the same file.
    return b64encode(gzip.compress(text.encode(), mtime=0)).decode()


def stills(pictures: Mapping[str, Callable[[], Figure]]) -> list[dict[str, str]]:
    """Draw pictures for paper: name and data of each, and whether it takes a whole line."""
    from tribo.kernel_api import house_style

    drawn = []
    for name, draw in pictures.items():
        image = BytesIO()
        with house_style():
            figure = draw()
            figure.savefig(image, format="png", dpi=STILL_DPI)
        data = b64encode(image.getvalue()).decode()
        wide = "wide" if figure.get_figwidth() > WIDE else ""
        drawn.append({"name": name.replace("_", " "), "data": data, "look": wide})
    return drawn


def write_page(page: str, path: Path) -> None:
    """Write a report, and see that it is as small as promised."""
    if len(page.encode()) > LARGEST:
        raise CaseError(f"{path} would have more than {LARGEST / 1e6:g} MB")
    write_file(path, page)
