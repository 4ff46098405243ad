"""What is installed, read so that one malformed distribution harms no other."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import metadata


def entry_points() -> Iterator[tuple[metadata.Distribution, metadata.EntryPoint]]:
    """Yield every entry point with its distribution; of a name twice, the one found first.

    A distribution whose metadata cannot be read is passed over.
    """
    seen: set[str] = set()
    for distribution in metadata.distributions():
        try:
            name = distribution.name
            points = list(distribution.entry_points)
            if not name or not distribution.version or name in seen:
                continue
        except Exception:
            continue
        seen.add(name)
        for point in points:
            yield distribution, point
