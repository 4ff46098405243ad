"""Show what `tests/trials.py` found in an executed page."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from IPython.display import Markdown

FIGURES = Path(os.environ["TRIBO_REPOSITORY"]) / "docs" / "_data" / "trust.json"


def made_on() -> Markdown:
    """Return with what the figures were found."""
    found = _found()
    listed = ", ".join(f"{name} {version}" for name, version in found["packages"].items())
    return Markdown(
        f"Python {found['python']}, {listed}; {found['system']}, {found['cores']} cores; seed "
        f"{found['seed']}."
    )


def table() -> Markdown:
    """Return each trial with its figures."""
    lines = ["| trial | holds | figures |", "| --- | --- | --- |"]
    for row in _found()["trials"]:
        figures = ", ".join(
            f"{name.replace('_', ' ')}: {_shown(value)}" for name, value in row["figures"].items()
        )
        lines.append(f"| {row['trial']} | {'yes' if row['good'] else 'no'} | {figures} |")
    return Markdown("\n".join(lines))


def _shown(value: object) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{key} × {count}" for key, count in value.items())
    return str(value)


def _found() -> dict[str, Any]:
    found: dict[str, Any] = json.loads(FIGURES.read_text(encoding="utf-8"))
    return found
