"""Installed distributions: entry points and requirements."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from importlib import metadata

from packaging.requirements import InvalidRequirement, Requirement


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


def applies(requirement: str) -> bool:
    """Return whether the marker of a requirement, as ``; python_version < "3.12"``, holds here."""
    marker = Requirement(requirement).marker
    return marker is None or marker.evaluate({"extra": ""})


def lacking(requirement: str) -> str:
    """Return why a requirement is not met; empty if it is met or does not apply."""
    needed = Requirement(requirement)
    if not applies(requirement):
        return ""
    try:
        version = metadata.version(needed.name)
    except metadata.PackageNotFoundError:
        return f"{needed.name} is not installed"
    if needed.specifier.contains(version, prereleases=True):
        return ""
    return f"{needed.name} is installed in version {version}"


def unmet(distribution: str) -> str:
    """Return which requirement of a distribution is not met; empty if all are."""
    for requirement in metadata.distribution(distribution).requires or ():
        with suppress(InvalidRequirement):
            if lack := lacking(requirement):
                return f"it requires {requirement}, but {lack}; mend that with pip"
    return ""
