"""Entry points of installed distributions."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from importlib import metadata


def entry_points(group: str) -> Iterator[tuple[metadata.Distribution, metadata.EntryPoint]]:
    """Yield the entry points of a group and of those below it, each with its distribution.

    ``tribo.2`` is below ``tribo``. Unreadable metadata are skipped.
    """
    known = set()
    for found in metadata.distributions():
        with suppress(Exception):
            points = [p for p in found.entry_points if f"{p.group}.".startswith(f"{group}.")]
            # A folder may be searched twice, and of leftovers of a package the first is in use.
            if points and found.version and found.name not in known:
                known.add(found.name)
                yield from ((found, point) for point in points)
