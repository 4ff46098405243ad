"""Show what `benchmarks.speed.all` measured in an executed page."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from IPython.display import Markdown

Row = Mapping[str, Any]
REPOSITORY = Path(os.environ["TRIBO_REPOSITORY"])
FIGURES = Path("docs") / "_data" / "speed.json"
STARTS = ("cold", "warm")


def table(
    benchmark: str,
    title: str,
    columns: Mapping[str, str],
    keep: Callable[[Row], bool] = lambda _: True,
) -> Markdown:
    """Return the rows of one table that `keep` keeps; `columns` has a heading for each key."""
    rows = [row for row in _measured(REPOSITORY)[benchmark]["tables"][title] if keep(row)]
    return _markdown(list(columns.values()), [[_cell(row[key]) for key in columns] for row in rows])


def solves() -> Markdown:
    """Return the ratios of all contact solves, cold / warm, with a column for each package."""
    rows = _measured(REPOSITORY)["contact_solve"]["tables"]["Solves"]
    ratios = {(r["contact"], r["cells"], r["package"], r["start"]): r["ratio"] for r in rows}
    packages = list(dict.fromkeys(row["package"] for row in rows))
    # Ratios over itself are 1.
    packages.remove("tribo")
    lines = [
        [contact, f"{cells}²"]
        + [
            " / ".join(_cell(ratios.get((contact, cells, name, start))) for start in STARTS)
            for name in packages
        ]
        for contact, cells in dict.fromkeys((row["contact"], row["cells"]) for row in rows)
    ]
    return _markdown(["contact", "cells", *packages], lines)


def machine() -> Markdown:
    """Return on what and when the figures were measured, and how busy it was."""
    loads: dict[str, float] = {}
    times: dict[str, list[str]] = {}
    for name, benchmark in _measured(REPOSITORY).items():
        found = benchmark["machine"]
        times.setdefault(f"{found['date']}, commit {found['commit']}", []).append(f"`{name}`")
        versions = {"Python": found["python"], **found["packages"]}
        listed = ", ".join(f"{name} {version}" for name, version in versions.items() if version)
        kind = f"Measured on: {found['cpu']}, {found['cores']} cores, {found['system']}; {listed}"
        loads[kind] = max(loads.get(kind, 0.0), found["load_average"])
    lines = [f"{kind}; load average {x:.1f}." for kind, x in loads.items()]
    lines += [f"Of {time}: {', '.join(names)}." for time, names in times.items()]
    return Markdown("\n\n".join(lines))


def _measured(repository: Path) -> dict[str, Any]:
    measured: dict[str, Any] = json.loads((repository / FIGURES).read_text(encoding="utf-8"))
    return measured


def _markdown(heading: list[str], rows: list[list[str]]) -> Markdown:
    lines = [heading, ["---:"] * len(heading), *rows]
    return Markdown("\n".join(f"| {' | '.join(line)} |" for line in lines))


def _cell(value: object) -> str:
    if value is None:
        return "–"
    if isinstance(value, float):
        return f"{value:.0f}" if value >= 100 else f"{value:.2g}"
    return str(value)
