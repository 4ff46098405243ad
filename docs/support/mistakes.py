"""Show in an executed page which mistakes the conformance kit finds, and by what."""

from __future__ import annotations

import json
import os
from pathlib import Path

from IPython.display import Markdown

from tribo.testing.kit import SUITES, names_of

FOUND = Path(os.environ["TRIBO_REPOSITORY"]) / "docs" / "_data" / "mistakes.json"


def checks() -> Markdown:
    """Return every check with the fact that it tests, and the kinds of components it is for."""
    kinds: dict[tuple[str, str], list[str]] = {}
    for kind, suite in SUITES.items():
        for name in names_of(suite):
            fact = str(getattr(suite, name).__doc__).splitlines()[0]
            kinds.setdefault((name, fact), []).append(kind.replace("_", " "))
    lines = ["| check | of | fact |", "| --- | --- | --- |"]
    for (name, fact), of in kinds.items():
        every = "all" if len(of) == len(SUITES) else ", ".join(of)
        lines.append(f"| `{name}` | {every} | {fact} |")
    return Markdown("\n".join(lines))


def share() -> Markdown:
    """Return how many of the mistakes are found."""
    rows = json.loads(FOUND.read_text(encoding="utf-8"))
    found = sum(bool(row["found_by"]) for row in rows)
    return Markdown(f"Found are {found} of {len(rows)}, {100 * found / len(rows):.0f} %.")


def table() -> Markdown:
    """Return each mistake with the first checks that find it, of how many."""
    lines = ["| mistake | in a | found by |", "| --- | --- | --- |"]
    for row in json.loads(FOUND.read_text(encoding="utf-8")):
        names, more = row["found_by"][:2], len(row["found_by"]) - 2
        by = ", ".join(f"`{name}`" for name in names) or "*nothing*"
        by += f" and {more} more" if more > 0 else ""
        lines.append(f"| {row['mistake']} | {row['kind']} | {by} |")
    return Markdown("\n".join(lines))
