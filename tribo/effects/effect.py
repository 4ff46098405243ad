"""The interface of effects: what lies between the bodies."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar, Literal

from tribo.component import Component
from tribo.core.arrays import Array
from tribo.core.contact import ContactSystem
from tribo.core.fields import ContactConditions, Field
from tribo.core.state import Snapshot


class Effect(Component):
    """What lies between the bodies, such as a temperature, debris or a film.

    It provides fields of the solved contact, which wear laws and other effects
    read, and may own state that evolves with the run. Every pass of a step
    asks it anew, so that its answers must follow from its configuration and
    what it is given alone.

    State is integrated inside each step, at the pressure of the step, to an
    accuracy of its own; steps of the contact need not be short for it.
    """

    provides: ClassVar[tuple[Field, ...]] = ()
    """The fields it answers with."""

    requires: ClassVar[tuple[str | Field, ...]] = ()
    """Fields it needs of other effects, of the case, or of the state of a wear law: their names, or
    a `Field` with the limits and the typical value at which the conformance kit tries it."""

    state_fields: ClassVar[tuple[Field, ...]] = ()
    """What it remembers; each field starts at `initial_state`, is kept in the result, and answers
    whoever requires its name."""

    reach: ClassVar[Literal["point", "contact"] | tuple[int, int] | None] = None
    """What its fields and rates at a point follow: the ``"point"`` alone; the load and the area of
    the ``"contact"`` too; or points so many cells away along x and y. Gradients need it, or
    `pull_back`."""

    def check(self, system: ContactSystem, swept: frozenset[str], solver: str) -> None:
        """Raise `CaseError` if the effect cannot serve this contact.

        Parameters
        ----------
        system : ContactSystem
            The contact: its window, materials by body, elastic layers and hardness.
        swept : frozenset of str
            Names of the bodies whose points pass through the contact.
        solver : str
            The type of the contact solver, such as ``"dcfft"``.
        """

    def carrier(self) -> str | None:
        """Return the body whose surface carries the state and moves it; None for the contact.

        In the contact frame one state serves all positions of a cycle. What is uniform has no
        carrier. Of two effects with a state of one name, one on each body, laws and other effects
        have for each body the state on it; a state that stands alone in a case is that of both.
        """
        return None

    def initial_state(self) -> dict[str, float]:
        """Return the initial value of each state field; zero unless overridden."""
        return {field.name: 0.0 for field in self.state_fields}

    def fields(self, contact: ContactConditions) -> Mapping[str, Mapping[str, Array]]:
        """Return each provided field for each body.

        Parameters
        ----------
        contact : ContactConditions
            The contact; its arrays must not be written to.

        Returns
        -------
        Mapping[str, Mapping[str, ndarray]]
            By field name and body name; arrays that broadcast to (nx, ny).
        """
        return {}

    def load_factor(self, snapshot: Snapshot) -> float:
        """Return what multiplies the normal load of the step that starts from a state; 1 by itself.

        It is more than 0, as of a spring, a lever or a control, and held over the step: of first
        order in its length. The factors of several effects multiply each other.
        """
        return 1.0

    def pull_back(
        self, contact: ContactConditions, cotangents: Mapping[str, Mapping[str, Array]]
    ) -> Mapping[str, Array | float]:
        """Return the derivatives of a number in what `fields` follow: a vector-Jacobian product.

        Optional: with it gradients go through fields that reach across the contact.

        Parameters
        ----------
        contact : ContactConditions
            As in `fields`.
        cotangents : Mapping[str, Mapping[str, ndarray]]
            The derivatives of the number in each provided field, by body, shape (nx, ny).

        Returns
        -------
        Mapping[str, ndarray or float]
            By path in `contact` or the configuration, such as ``"pressure"``, ``"state.film"``,
            ``"fields.friction_coefficient.ball"``, ``"system.materials.ball.young"``, ``"width"``.
            What is left out has the derivative 0.
        """
        raise NotImplementedError

    def state_rates(self, contact: ContactConditions) -> Mapping[str, Array]:
        """Return by how much each state field changes per second.

        What goes with sliding is a rate per metre times `contact.speed`, which
        is 0 while the motion rests; what relaxes in time goes on then.

        Parameters
        ----------
        contact : ContactConditions
            The contact, with the depth rates of both bodies; its arrays must not be written to.

        Returns
        -------
        Mapping[str, ndarray]
            By field name; arrays that broadcast to (nx, ny), one number of a uniform field.
        """
        return {}
