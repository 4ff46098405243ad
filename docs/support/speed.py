"""Show what `benchmarks.speed.all` measured in an executed page."""

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
    """Return on what and when the figures were measured, and how busy it was."""
    loads: dict[str, float] = {}
    times: dict[str, list[str]] = {}
    for name, benchmark in _measured().items():
        found = benchmark["machine"]
        times.setdefault(f"{found['date']}, commit {found['commit']}", []).append(f"`{name}`")
        versions = {"Python": found["python"], **found["packages"]}
        listed = ", ".join(f"{name} {version}" for name, version in versions.items() if version)
        kind = f"Measured on: {found['cpu']}, {found['cores']} cores, {found['system']}; {listed}"
        loads[kind] = max(loads.get(kind, 0.0), found["load_average"])
    lines = [f"{kind}; load average {x:.1f}." for kind, x in loads.items()]
    lines += [f"Of {time}: {', '.join(names)}." for time, names in times.items()]
    return Markdown("\n\n".join(lines))


def _measured() -> dict[str, Any]:
    measured: dict[str, Any] = json.loads(FIGURES.read_text(encoding="utf-8"))
    return measured


def _cell(value: object) -> str:
    if value is None:
        return "–"
    if isinstance(value, float):
        return f"{value:.0f}" if value >= 100 else f"{value:.2g}"
    return str(value)
