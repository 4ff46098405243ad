"""What is installed, read so that one malformed distribution harms no other."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from importlib import metadata

from packaging.requirements import InvalidRequirement, Requirement

_NAME = re.compile(r"^Name:\s*(\S+)", re.MULTILINE)
_VERSION = re.compile(r"^Version:\s*(\S+)", re.MULTILINE)


def with_entry_points(
    mention: str = "",
) -> Iterator[tuple[metadata.Distribution, list[metadata.EntryPoint]]]:
    """Yield every distribution that has entry points; of a name twice, the one found first.

    One whose metadata cannot be read is passed over.

    Parameters
    ----------
    mention : str, optional
        Text that its entry points must have somewhere: to parse those of everything installed
        would take most of composing a run.
    """
    # The same folder may be searched twice.
    seen: set[str] = set()
    for distribution in metadata.distributions():
        try:
            text = distribution.read_text("entry_points.txt")
            if not text or mention not in text:
                continue
            name = _name_if_found(distribution)
            points = list(distribution.entry_points)
        except Exception:
            continue
        if name and name not in seen:
            seen.add(name)
            yield distribution, points


def _name_if_found(distribution: metadata.Distribution) -> str:
    """Return its name if it has a version and is what is found by that name, or nothing."""
    text = metadata_text(distribution)
    name, version = _NAME.search(text), _VERSION.search(text)
    if not (name and version):
        return ""
    found = metadata.distribution(name[1])
    same = (metadata_text(found), found.locate_file("")) == (text, distribution.locate_file(""))
    return name[1] if same else ""


def applies(requirement: str) -> bool:
    """Return whether a requirement, as ``"numpy>=2; python_version < '3.12'"``, is one here."""
    marker = Requirement(requirement).marker
    return marker is None or marker.evaluate({"extra": ""})


def lacking(requirement: str) -> str:
    """Return what lacks where a requirement is not met; empty if it is met or does not apply."""
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
    """Return which requirement of a distribution does not hold; empty if all do."""
    for requirement in metadata.distribution(distribution).requires or ():
        with suppress(InvalidRequirement):
            if lack := lacking(requirement):
                return f"it requires {requirement}, but {lack}; mend that with pip"
    return ""


def metadata_text(distribution: metadata.Distribution) -> str:
    """Return the metadata of a distribution as they stand in its file; empty if there are none."""
    return distribution.read_text("METADATA") or distribution.read_text("PKG-INFO") or ""


def entry_points() -> Iterator[tuple[metadata.Distribution, metadata.EntryPoint]]:
    """Yield every entry point with its distribution."""
    for distribution, points in with_entry_points():
        for point in points:
            yield distribution, point
