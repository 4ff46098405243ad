"""The tables of `tribo verify --json` for an executed page."""

from __future__ import annotations

import json
import os
import platform
import subprocess
import sys
from collections.abc import Iterator
from itertools import groupby
from pathlib import Path
from typing import Any

from IPython.display import Markdown

NOTHING = "–"
MUTANTS = Path(os.environ["TRIBO_REPOSITORY"]) / "docs/_data/mutants.json"


def verified() -> dict[str, Any]:
    """Run the suite and return its JSON; fail if a check does."""
    command = [sys.executable, "-m", "tribo", "verify", "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"tribo verify exited with {done.returncode}:\n{done.stderr}")
    found: dict[str, Any] = json.loads(done.stdout)
    return found


def made_on(found: dict[str, Any]) -> Markdown:
    """Return with what and on what the numbers were computed."""
    packages = ", ".join(f"{name} {version}" for name, version in found["packages"].items())
    machine = f"{platform.machine()}, {os.cpu_count()} processors"
    return Markdown(f"Python {found['python']} on {found['platform']} ({machine}); {packages}.")


def table(found: dict[str, Any]) -> Markdown:
    """Return every row, the case named in its first."""
    return Markdown("\n".join(_lines(found["rows"])))


def _lines(rows: list[dict[str, Any]]) -> Iterator[str]:
    yield "| Case, source | Quantity, kind | Expected | Got | Error, order (theory) |"
    yield "| --- | --- | ---: | ---: | ---: |"
    for (case, source), group in groupby(rows, lambda row: (row["case"], row["source"])):
        title = f"**{case.replace('_', '_<wbr>')}**<br>{source}"
        for row in group:
            order = f", {row['order']:.2f} ({row['theory']:g})" if row["order"] else ""
            error = NOTHING if row["error"] is None else f"{row['error']:.1e}{order}"
            kind = f"{row['kind']}, published" if row["published"] else row["kind"]
            cells = [
                title,
                f"{row['quantity']} {row['solver']}<br>*{kind}*: {row['reason']}",
                _value(row["expected"], row["unit"]),
                _value(row["got"], row["unit"]),
                error,
            ]
            yield f"| {' | '.join(cell.replace('|', '/') for cell in cells)} |"
            title = ""


def mistakes() -> Markdown:
    """Return the mutants, each with its file and what finds it."""
    rows = json.loads(MUTANTS.read_text(encoding="utf-8"))
    lines = [
        f"| {row['mutant']} | `{row['file'].split('/src/')[-1]}` | `{row['case']}` |"
        for row in rows
    ]
    return Markdown("\n".join(["| Mistake | In | Found by |", "| --- | --- | --- |", *lines]))


def _value(value: float | None, unit: str) -> str:
    if value is None:
        return NOTHING
    return f"{value:.5g}" if unit == "1" else f"{value:.5g} {unit}"
