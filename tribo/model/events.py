"""The events of a step, as they happen; a gradient differentiates them in reverse."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from tribo.core.arrays import Array
from tribo.core.contact import ContactSolution

if TYPE_CHECKING:
    from tribo.evolution.interval import Interval
    from tribo.evolution.states import Memory
    from tribo.integration.integrator import Share


class Listener:
    """Learns the events of each step, rejected ones too; this one ignores them, as a run does."""

    def worn(
        self,
        contacts: Sequence[ContactSolution],
        interval: Interval,
        before: Memory,
        plan: Sequence[Share],
        *,
        ahead: bool = False,
    ) -> None:
        """Learn that the bodies were worn over an interval, under contacts, from a memory.

        The interval was divided as in `plan`. `ahead` is whether the contacts were solved before
        it, without its wear. At rest only interfacial effects evolve.
        """

    def solved(self, contacts: Sequence[ContactSolution]) -> None:
        """Learn that the contacts of a cycle were solved, without wear."""

    def yielded(self, places: Sequence[int]) -> None:
        """Learn that the overlap at some positions became plastic depth."""

    def drawn(self, before: Mapping[str, Array]) -> None:
        """Learn that the plastic depths of the bodies, by name, were drawn out along the track."""
