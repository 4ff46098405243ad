"""Show what `benchmarks/all.py` measured in an executed page."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from IPython.display import Markdown

Row = Mapping[str, Any]
FIGURES = Path(os.environ["TRIBO_REPOSITORY"]) / "docs" / "_data" / "speed.json"


def table(
    benchmark: str,
    title: str,
    columns: Mapping[str, str],
    keep: Callable[[Row], bool] = lambda _: True,
) -> Markdown:
    """Return the rows of one table that `keep` keeps; `columns` has a heading for each key."""
    rows = [row for row in _measured()[benchmark]["tables"][title] if keep(row)]
    lines = [list(columns.values()), ["---:"] * len(columns)]
    lines += [[_cell(row[key]) for key in columns] for row in rows]
    return Markdown("\n".join(f"| {' | '.join(line)} |" for line in lines))


def machine() -> Markdown:
    """Return what the figures were measured on, and how busy it was, in a sentence for each."""
    loads: dict[str, float] = {}
    for benchmark in _measured().values():
        found = benchmark["machine"]
        versions = {"Python": found["python"], **found["packages"]}
        listed = ", ".join(f"{name} {version}" for name, version in versions.items() if version)
        kind = f"Measured on: {found['cpu']}, {found['cores']} cores, {found['system']}; {listed}"
        loads[kind] = max(loads.get(kind, 0.0), found["load_average"])
    return Markdown("\n\n".join(f"{kind}; load average {x:.1f}." for kind, x in loads.items()))


def _measured() -> dict[str, Any]:
    measured: dict[str, Any] = json.loads(FIGURES.read_text(encoding="utf-8"))
    return measured


def _cell(value: object) -> str:
    if value is None:
        return "–"
    if isinstance(value, float):
        return f"{value:.0f}" if value >= 100 else f"{value:.2g}"
    return str(value)
