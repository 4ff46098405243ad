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
    names: dict[str, None] = {}
    for distribution in metadata.distributions():
        with suppress(Exception):
            # Parsing everything that is installed would take most of composing a run.
            text = distribution.read_text("entry_points.txt") or ""
            if f"[{group}]" in text or f"[{group}." in text:
                names[distribution.name] = None
    for name in names:
        # By name: of a folder that is searched twice, and of leftovers, the one in use.
        with suppress(Exception):
            found = metadata.distribution(name)
            if found.version:
                for point in found.entry_points:
                    if f"{point.group}.".startswith(f"{group}."):
                        yield found, point


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
