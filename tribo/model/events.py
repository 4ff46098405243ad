"""The events of a step, as they happen; a gradient differentiates them in reverse."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from tribo.core.arrays import Array
from tribo.core.contact import ContactSolution

if TYPE_CHECKING:
    from tribo.evolution.interval import Interval
    from tribo.evolution.states import Memory
    from tribo.integration.division import Division


@dataclass(frozen=True)
class Worn:
    """The bodies were worn over an interval, under `contacts`.

    It began with a memory, and was divided as in `plan`. `ahead` is whether the contacts were
    solved before it, without its wear. At rest only interfacial effects evolve.
    """

    contacts: Sequence[ContactSolution]
    interval: Interval
    before: Memory
    plan: Division
    ahead: bool = False


@dataclass(frozen=True)
class Solved:
    """The contacts at the positions of a cycle were solved, without wear."""

    contacts: Sequence[ContactSolution]


@dataclass(frozen=True)
class Yielded:
    """The overlap at some positions became plastic depth."""

    places: Sequence[int]


@dataclass(frozen=True)
class Drawn:
    """The plastic depths of the bodies, by name, were drawn out along the track."""

    before: Mapping[str, Array]


Event = Worn | Solved | Yielded | Drawn
Listener = Callable[[Event], None]


def unheard(event: Event) -> None:
    """Ignore an event, as a run does."""
