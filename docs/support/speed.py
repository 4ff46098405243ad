"""Show what `benchmarks.speed.all` measured in an executed page, unless it is too old."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from IPython.display import Markdown

Row = Mapping[str, Any]
REPOSITORY = Path(os.environ["TRIBO_REPOSITORY"])
FIGURES = Path("docs") / "_data" / "speed.json"
LIMIT, FAST = "limit", ", compiled"
HOURS = (
    ("hour", "The paper's hour", "hour", "256²"),
    ("resolved_loop", "resolved hour", "hour, 33 positions", "128²"),
)
MEASURED = ("tribo/contact", "tribo/stepping", "plugins/tribo-fast/src")
MOST_COMMITS = 40
"""A change of a solver takes up to ten commits: figures may miss four such changes."""


def outdated(repository: Path) -> str | None:
    """Return which figures are older than so many commits; None without their history."""
    old = {
        name: count
        for name, benchmark in _measured(repository).items()
        if (count := _commits_since(repository, benchmark["machine"]["commit"])) > MOST_COMMITS
    }
    if not old:
        return None
    return (
        f"{FIGURES}: {max(old.values())} commits changed {' or '.join(MEASURED)} since figures "
        f"were measured, at most {MOST_COMMITS} are allowed; measure again, on a quiet machine: "
        f"python -m benchmarks.speed.all {' '.join(old)}"
    )


def _commits_since(repository: Path, commit: str) -> int:
    command = ["git", "-C", str(repository), "rev-list", "--count", f"{commit}..HEAD", "--"]
    with suppress(OSError, subprocess.CalledProcessError):
        return int(subprocess.run([*command, *MEASURED], capture_output=True, check=True).stdout)
    return 0


def ratios() -> Markdown:
    """Return times over tribo's with NumPy: of contact solves, cold / warm, of hours, of memory."""
    found = _measured(REPOSITORY)
    solves = found["contact_solve"]["tables"]["Solves"]
    lines: dict[tuple[str, ...], dict[str, list[float | None]]] = {}
    for row in solves:
        line = lines.setdefault((row["contact"], f"{row['cells']}²"), {})
        line.setdefault(row["package"], [None, None])[row["start"] == "warm"] = row["ratio"]
    for name, title, *key in HOURS:
        rows = {row["method"]: [row["ratio"]] for row in found[name]["tables"][title]}
        own = next(method for method in rows if method.endswith(FAST))
        of_peers = {method.removeprefix("loop on "): ratio for method, ratio in rows.items()}
        lines[tuple(key)] = {**of_peers, f"tribo{FAST}": rows[own]}
    for row in found["fft_limit"]["tables"]["Distance to the limit"]:
        contact = row["what"].partition(", ")[2] or HOURS[0][2]
        line = lines.get((contact, f"{row['cells']}²"), {})
        line.setdefault(LIMIT, []).append(row["limit"])
    rough = [r for r in solves if r["contact"] == "rough" and r["bytes_a_cell"]]
    sizes = {(row["cells"], row["package"]): row["bytes_a_cell"] for row in rough}
    for (cells, package), size in sizes.items():
        line = lines.setdefault(("memory of *rough*", f"{cells}²"), {})
        line[package] = [size / sizes[cells, "tribo"]]
    packages = [*dict.fromkeys(row["package"] for row in solves if row["package"] != "tribo")]
    columns = [*packages, LIMIT]
    ratios = [
        [*key, *(" / ".join(map(_cell, line.get(name, [None]))) for name in columns)]
        for key, line in lines.items()
    ]
    return _markdown(["", "cells", *columns], ratios)


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
