"""Show what the studies `moving_contact` and `resolved_hour` found in an executed page."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from IPython.display import Markdown

DATA = Path(os.environ["TRIBO_REPOSITORY"]) / "docs" / "_data"
QUANTITIES = {
    "groove of the disk, µm": "groove_{}_um",
    "ball depth, µm": "ball_{}_um",
    "crown of the ball, µm": "crown_{}_um",
    "contact along, mm": "along_{}_mm",
    "centre pressure, MPa": "centre_{}_MPa",
}
RESOLVED = {
    "groove at mid-stroke, µm": "groove_um",
    "groove where the contact turns round, µm": "end_of_stroke_um",
    "ball depth, µm": "ball_um",
    "crown of the ball, µm": "crown_um",
    "contact along at mid-stroke, mm": "along_mm",
    "centre pressure, MPa": "centre_MPa",
}


def hours() -> Markdown:
    """Return the paper's hour, and that with the weighed losses, by the average and resolved."""
    rows = _rows("paper")
    lines = [["", *(f"{row['case']}, {how}" for row in rows for how in ("average", "resolved"))]]
    lines += [
        [name, *(_cell(row[key.format(how)]) for row in rows for how in ("average", "resolved"))]
        for name, key in QUANTITIES.items()
    ]
    return table(lines)


def positions() -> Markdown:
    """Return the hour of both cases by the average and at 33 positions, on two grids."""
    rows = _rows("resolved hour", "resolved_hour")
    shown = [row for row in rows if row["positions"] != "average" or row["cells"] == 96]
    shown.sort(key=lambda row: (row["case"], row["positions"] != "average"))
    lines = [["", *(f"{row['case']}, {_how(row)}" for row in shown)]]
    lines += [[name, *(_cell(row[key]) for row in shown)] for name, key in RESOLVED.items()]
    return table(lines)


def _how(row: dict[str, Any]) -> str:
    return "average" if row["positions"] == "average" else f"{row['cells']}² cells"


def grooves() -> Markdown:
    """Return by how much the average is too deep, by wear coefficients, stroke and groove."""
    lines = [["k of ball : disk", "stroke, mm", "shallow groove", "deeper", "deepest"]]
    for ratio, name in ((1.0, "1 : 1"), (10.0, "1 : 10"), (None, "0 : 1")):
        rows = _rows("grooves" if ratio else "ball that does not wear")
        rows = [row for row in rows if row.get("flat_over_ball") == ratio]
        for stroke in sorted({row["stroke_mm"] for row in rows}):
            cells = [
                f"{row['too_deep_percent']:+.1f} % ({row['half_widths']:.2g} b, "
                f"{row['groove_over_approach']:.2g} δ)"
                for row in rows
                if row["stroke_mm"] == stroke
            ]
            lines.append([name, f"{stroke:.3g}", *cells])
    return table(lines)


def short_strokes() -> Markdown:
    """Return by how much the average is too deep for short strokes and little wear."""
    rows = _rows("short strokes, worn little")
    return table(
        [
            ["stroke, half-widths", *(f"{row['half_widths']:.2g}" for row in rows)],
            ["too deep by", *(f"{row['too_deep_percent']:+.0f} %" for row in rows)],
        ]
    )


def _rows(title: str, data: str = "moving_contact") -> list[dict[str, Any]]:
    text = (DATA / f"{data}.json").read_text(encoding="utf-8")
    rows: list[dict[str, Any]] = json.loads(text)["tables"][title]
    return rows


def _cell(value: float) -> str:
    return f"{value:.0f}" if value >= 100 else f"{value:.2f}"


def table(lines: Sequence[Sequence[str]]) -> Markdown:
    """Return a table, its first line the head."""
    head, *rest = lines
    ruled = [head, ["---:"] * len(head), *rest]
    return Markdown("\n".join(f"| {' | '.join(line)} |" for line in ruled))
