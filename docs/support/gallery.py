"""Run a case of the gallery in an executed page, and set it against what was published."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from IPython.display import Markdown

from tribo import Result, Simulation, TriboWarning, load_case, templates, verification

CASES = Path(os.environ["TRIBO_REPOSITORY"]) / "examples" / "gallery"
VALIDATED = Path(verification.__file__).parent / "cases"
TEMPLATES = Path(templates.__file__).parent
Rows = Mapping[str, tuple[float, float, float]]
"""By quantity with its unit: published, tribo's, and by how many percent they may differ."""


def run(name: str, *changes: str) -> Result:
    """Run a case or template with `changes`, as ``"grid.cells=64"``."""
    path = VALIDATED / name / "case.toml"
    if not path.exists():
        path = (TEMPLATES if name in templates.TEMPLATES else CASES) / f"{name}.toml"
    with warnings.catch_warnings():
        # What it warns of, the result has as notices.
        warnings.simplefilter("ignore", TriboWarning)
        return Simulation(load_case(path, overrides=changes)).run()


def end(result: Result) -> Mapping[str, Any]:
    """Return the measures at the last save."""
    last: Mapping[str, Any] = result.saves()[-1]
    return last


def beside(rows: Rows, published: str, ours: str = "tribo") -> Markdown:
    """Return a table of both and their difference; fail where that is larger than it may be."""
    lines = [f"| | {published} | {ours} | difference |", "| --- | ---: | ---: | ---: |"]
    for quantity, (theirs, found, most) in rows.items():
        percent = 100 * (found / theirs - 1)
        if abs(percent) > most:
            raise ValueError(f"{quantity}: {found:.4g} is {percent:+.1f} % off {theirs:.4g}")
        lines.append(f"| {quantity} | {theirs:.4g} | {found:.4g} | {percent:+.1f} % |")
    return Markdown("\n".join(lines))
