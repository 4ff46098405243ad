"""What is installed, read so that one malformed distribution harms no other."""

from __future__ import annotations

import re
from collections.abc import Iterator
from importlib import metadata

_NAME = re.compile(r"^Name:\s*(\S+)", re.MULTILINE)
_VERSION = re.compile(r"^Version:\s*(\S+)", re.MULTILINE)


def with_entry_points() -> Iterator[tuple[metadata.Distribution, list[metadata.EntryPoint]]]:
    """Yield every distribution that has entry points; of a name twice, the one found first.

    One whose metadata cannot be read is passed over.
    """
    seen: set[str] = set()
    for distribution in metadata.distributions():
        try:
            points = list(distribution.entry_points)
            if not points:
                continue
            # To parse the metadata of everything installed would take most of composing a run.
            text = metadata_text(distribution)
        except Exception:
            continue
        name, version = _NAME.search(text), _VERSION.search(text)
        if name and version and name[1] not in seen:
            seen.add(name[1])
            yield distribution, points


def metadata_text(distribution: metadata.Distribution) -> str:
    """Return the metadata of a distribution as they stand in its file; empty if there are none."""
    return distribution.read_text("METADATA") or distribution.read_text("PKG-INFO") or ""


def entry_points() -> Iterator[tuple[metadata.Distribution, metadata.EntryPoint]]:
    """Yield every entry point with its distribution."""
    for distribution, points in with_entry_points():
        for point in points:
            yield distribution, point
