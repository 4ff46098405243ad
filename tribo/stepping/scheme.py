"""The scheme of integration in time: what both schemes share."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, ClassVar

from tribo.core.state import State
from tribo.core.table import Table
from tribo.stepping.step import distance_until, rested, start_sliding

if TYPE_CHECKING:
    from tribo.model.model import Model


class Scheme(Table, ABC):
    """A scheme of integration in time; a closed, built-in choice."""

    needs_wear_compliance: ClassVar[bool] = False
    """Whether contacts are solved with the wear of a step as compliance."""

    def check(self, model: Model, state: State) -> None:
        """Raise `CaseError` if the first step from `state` is refused."""

    def advance(self, model: Model, state: State, until: float) -> State:
        """Return the next accepted state, at `until` (s) at the latest.

        Raises
        ------
        NumericalError
            If no step can be carried out.
        """
        time = self.next_time(state, until)
        target = distance_until(model, state, time)
        if target is None:
            return rested(model, state, time)
        return self.slide(model, start_sliding(model, state), target, time)

    def next_time(self, state: State, until: float) -> float:
        """Return the time (s) at which the step must end, `until` (s) at the latest."""
        return until

    @abstractmethod
    def slide(self, model: Model, state: State, target: float, until: float) -> State:
        """Return the state after a step towards `target` (m), which is reached at `until` (s)."""

    @abstractmethod
    def step(self, model: Model, state: State, increment: float, time: float) -> State:
        """Return the state after one step of `increment` (m), which ends at a time (s)."""
