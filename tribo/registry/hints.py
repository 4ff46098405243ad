"""Distributions that may be meant as plugins, but cannot be found as such."""

from __future__ import annotations

import re
from contextlib import suppress
from importlib import metadata

from packaging.requirements import Requirement

from tribo.core.distributions import metadata_text
from tribo.registry.kinds import KINDS
from tribo.registry.loader import group, is_group

_NEEDS = re.compile(r"^Requires-Dist:\s*(tribo\b.*)$", re.MULTILINE | re.IGNORECASE)


def undeclared() -> list[str]:
    """Return a hint for each distribution that requires tribo and declares no plugin."""
    found = []
    for distribution in metadata.distributions():
        with suppress(Exception):
            # Text first: few distributions name tribo, and parsing all takes ten times as long.
            lines = _NEEDS.findall(metadata_text(distribution))
            if any(map(_needs_tribo, lines)) and not _declares(distribution):
                found.append(f"{distribution.name} {distribution.version}")
    groups = f"{group('KIND')}, KIND being one of {', '.join(KINDS)}"
    return [
        f"{which} requires tribo but declares no plugin; if it is one, add an entry point in "
        f"{groups}, and reinstall it"
        for which in sorted(set(found))
    ]


def _declares(distribution: metadata.Distribution) -> bool:
    return distribution.name == "tribo" or any(
        is_group(point.group) for point in distribution.entry_points
    )


def _needs_tribo(line: str) -> bool:
    requirement = Requirement(line)
    wanted = requirement.marker is None or requirement.marker.evaluate({"extra": ""})
    return requirement.name.lower() == "tribo" and wanted
