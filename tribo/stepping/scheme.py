"""How a run moves on in time: what both ways have in common."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any, ClassVar

from pydantic import ConfigDict

from tribo.core.findings import Finding
from tribo.core.state import State
from tribo.core.table import Table
from tribo.stepping.gap_filling import check_filling

if TYPE_CHECKING:
    from tribo.model.model import Model


def _type_required(schema: dict[str, Any]) -> None:
    # It has a default for those who make objects; in a case it tells the two apart.
    schema.setdefault("required", []).append("type")


class Scheme(Table, ABC):
    """A scheme of integration in time; a closed, built-in choice."""

    model_config = ConfigDict(json_schema_extra=_type_required)

    needs_wear_compliance: ClassVar[bool] = False
    """Whether contacts are solved with the wear of a step as compliance."""

    @property
    def may_oscillate(self) -> bool:
        """Whether a pressure that oscillates from step to step is only a finding."""
        return False

    def check(self, model: Model, state: State) -> Finding | None:
        """Return what is wrong with the first step from `state`, if anything is.

        Raises
        ------
        CaseError
            If that step cannot be taken, or what fills the gap draws the load together.
        """
        check_filling(model, state)
        return None

    @abstractmethod
    def advance(self, model: Model, state: State, until: float) -> State:
        """Return the next accepted state, at `until` (s) at the latest.

        Raises
        ------
        NumericalError
            If no step can be carried out.
        """

    @abstractmethod
    def step(self, model: Model, state: State, increment: float, time: float) -> State:
        """Return the state after one step of a given length.

        Parameters
        ----------
        model : Model
            The composed case.
        state : State
            Where the step starts.
        increment : float
            Sliding increment, in m; positive.
        time : float
            Time at the end, in s.
        """
