"""Which installed plugins may take part: the user's choice."""

from __future__ import annotations

import os
import re
import warnings
from collections.abc import Iterable
from dataclasses import replace

from tribo.core.errors import TriboWarning
from tribo.registry.loader import Source

ONLY = "TRIBO_PLUGINS"
DISABLED = "TRIBO_DISABLE_PLUGINS"


def selected(sources: Iterable[Source]) -> list[Source]:
    """Mark as disabled the plugins that the environment turns off.

    ``TRIBO_DISABLE_PLUGINS`` lists distributions, or names or prefixes of
    components, to leave out, separated by commas; ``*`` stands for all.
    ``TRIBO_PLUGINS`` lists the only ones that may take part. The command
    line's ``--no-plugin`` and ``--plugins`` set them, so that processes
    started from there make the same choice.
    """
    sources = list(sources)
    only, off = _names(ONLY), _names(DISABLED)
    known = set().union(*map(_answers_to, sources)) | {"*"}
    for name in sorted((only | off) - known):
        warnings.warn(f"no plugin is called {name!r}", TriboWarning, stacklevel=3)
    chosen = []
    for source in sources:
        answers = _answers_to(source)
        if off & (answers | {"*"}):
            reason = f"turned off by --no-plugin or {DISABLED}"
        elif ONLY in os.environ and not only & answers:
            reason = f"not among those that --plugins or {ONLY} names"
        else:
            chosen.append(source)
            continue
        record = replace(source.record, status="disabled", reason=reason)
        chosen.append(replace(source, record=record))
    return chosen


def turn_off(names: Iterable[str]) -> None:
    """Add to what this process and its children leave out."""
    os.environ[DISABLED] = ",".join([*sorted(_names(DISABLED)), *names])


def keep_only(names: Iterable[str]) -> None:
    """Let only these take part in this process and its children."""
    os.environ[ONLY] = ",".join(names)


def _names(variable: str) -> set[str]:
    parts = os.environ.get(variable, "").split(",")
    return {_normal(part) for part in parts if part.strip()}


def _normal(name: str) -> str:
    # Distributions are the same whatever their capitals, hyphens and underscores.
    return re.sub(r"[-_]+", "-", name.strip().lower())


def _answers_to(source: Source) -> set[str]:
    names = [name for _, name in source.declared or ()]
    prefixes = [name.split(".")[0] for name in names]
    return {_normal(name) for name in (source.record.distribution, *names, *prefixes)}
