"""Show what the study `rough_paper` found in an executed page."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from itertools import groupby
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
from IPython.display import Markdown
from matplotlib.figure import Figure
from moving import table

from tribo.plotting.style import house_style

FIGURES = Path(os.environ["TRIBO_REPOSITORY"]) / "docs" / "_data" / "rough_paper.json"
STYLES = ("-", "--", ":", "-.")
Row = Mapping[str, Any]
Runs = dict[tuple[int, int], list[Row]]


def hour() -> Markdown:
    """Return the rough ball and disk over the hour, the first seed on the first grid."""
    first = next(rows for (_, seed), rows in _runs("hour").items() if seed)
    lines = [["time, s", "peak, GPa", "contact, mm²", "plastic", "disk Sa, nm", "ball Sa, nm"]]
    lines += [
        [
            f"{row['time']:g}",
            f"{row['peak_GPa']:.2f}",
            f"{row['area_mm2']:.3f}",
            f"{100 * row['plastic_part']:.1f} %",
            *_worn(row),
        ]
        for row in first
    ]
    return table(lines)


def ends() -> Markdown:
    """Return the end of each run of the hour: seeds and grids beside each other."""
    lines = [
        ["cells", "seed", "groove, µm", "peak, GPa", "contact, mm²", "disk Sa, nm", "ball Sa, nm"]
    ]
    for (cells, seed), rows in _runs("hour").items():
        end = rows[-1]
        lines.append(
            [
                f"{cells}²",
                str(seed) if seed else "smooth",
                f"{end['groove_um']:.2f}",
                f"{end['peak_GPa']:.2f}",
                f"{end['area_mm2']:.3f}",
                *_worn(end),
            ]
        )
    return table(lines)


def patches() -> Markdown:
    """Return the patch over its path: mean over the seeds on the first grid, and the finer grid."""
    runs = _runs("patch")
    cells = sorted({grid for grid, _ in runs})
    lines = [
        ["path, mm", "cells", "peak, GPa", "touching", "of it plastic", "Sa of both, nm"],
    ]
    for grid in cells:
        of_grid = [rows for (each, _), rows in runs.items() if each == grid]
        for rows in zip(*of_grid, strict=True):
            mean = {name: sum(row[name] for row in rows) / len(rows) for name in rows[0]}
            lines.append(
                [
                    f"{1e3 * mean['path']:g}",
                    f"{grid}²" + (f", {len(rows)} seeds" if len(rows) > 1 else ""),
                    f"{mean['peak_GPa']:.2f}",
                    f"{100 * mean['area_mm2'] / PATCH_MM2:.0f} %",
                    f"{100 * mean['plastic_part']:.2f} %",
                    f"{0.5 * (mean['ball_Sa_nm'] + mean['disk_Sa_nm']):.3g}",
                ]
            )
    return table(lines)


def running_in() -> Figure:
    """Draw roughness over the sliding distance: the patch, each seed and grid."""
    with house_style():
        figure, (left, right) = plt.subplots(1, 2, figsize=(7.2, 3.0), layout="constrained")
        for style, ((cells, seed), rows) in zip(STYLES, _runs("patch").items(), strict=False):
            worn = [row for row in rows if row["path"] > 0]
            path = [1e3 * row["path"] for row in worn]
            roughness = [row["ball_Sa_nm"] for row in worn]
            left.semilogx(path, roughness, style, label=f"{cells}², seed {seed}")
            right.semilogx(path, [row["peak_GPa"] for row in worn], style)
        left.set(xlabel="sliding distance, mm", ylabel="Sa of the patch, nm", ylim=(0, None))
        right.set(xlabel="sliding distance, mm", ylabel="largest pressure, GPa")
        left.legend()
    return figure


def _worn(row: Row) -> list[str]:
    return [
        f"{row[f'{body}_Sa_nm']:.1f} ({row[f'{body}_unworn_nm']:.1f})" for body in ("disk", "ball")
    ]


def _runs(title: str) -> Runs:
    rows = json.loads(FIGURES.read_text(encoding="utf-8"))["tables"][title]
    groups = groupby(rows, key=lambda row: (row["cells"], row["seed"]))
    return {key: list(of_run) for key, of_run in groups}


PATCH_MM2 = 0.05**2
