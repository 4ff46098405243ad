"""The hooks by which a plugin takes part: all of them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import pluggy

if TYPE_CHECKING:
    from tribo.interfaces.component import Component

PROJECT = "tribo"
"""Name of the plugin manager, and group of the entry points that it reads."""

hookspec = pluggy.HookspecMarker(PROJECT)
hookimpl = pluggy.HookimplMarker(PROJECT)
"""Marks a function of a plugin as the implementation of the hook it is named after."""


@hookspec
def tribo_components() -> Iterable[type[Component[Any]]]:
    """Return the classes that a case may name; the base of each says of what kind it is."""
    return ()
