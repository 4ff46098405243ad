"""The interface of interfacial effects."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar, Literal

from tribo.component import Component
from tribo.core.arrays import Array
from tribo.core.contact import ContactSystem
from tribo.core.fields import ContactConditions, Field
from tribo.core.state import Snapshot


class Effect(Component):
    """An interfacial effect, such as a temperature, debris or a film.

    It provides fields of the solved contact, which wear laws and other effects read, and may own
    state that evolves with the run. Every pass of a step evaluates it again, so its answers must
    depend on its configuration and its input alone.

    State is integrated inside each step, at the pressure of the step, to an accuracy of its own;
    steps of the contact need not be short for it.

    Examples
    --------
    >>> class Heat(tribo.Effect):
    ...     provides = (tribo.Field("heat", "W/m^2", "Power of friction with μ = 0.25."),)
    ...     def fields(self, contact):
    ...         heat = 0.25 * contact.speed * contact.pressure
    ...         return {"heat": dict.fromkeys(contact.materials, heat)}
    >>> steel = {"ball": tribo.Material(name="100Cr6")}
    >>> system = tribo.ContactSystem(tribo.Grid("1 mm", 4), 115e9, load=1.0, materials=steel)
    >>> contact = tribo.ContactConditions(system, np.full((4, 4), 1e6), 0.5, 0, 0, frozenset())
    >>> float(Heat().fields(contact)["heat"]["ball"][0, 0])  # W/m² under 1 MPa at 0.5 m/s
    125000.0
    """

    provides: ClassVar[tuple[Field, ...]] = ()
    """The fields it provides."""

    requires: ClassVar[tuple[str | Field, ...]] = ()
    """Fields it needs from other effects, the case, or the state of a wear law: their names, or
    a `Field` with the limits and the typical value at which the conformance kit tries it."""

    state_fields: ClassVar[tuple[Field, ...]] = ()
    """Its states; each field starts at `initial_state`, is kept in the result, and is provided to
    laws and effects that require its name."""

    reach: ClassVar[Literal["point", "contact"] | None] = None
    """What its fields and rates at a point depend on: the ``"point"`` alone; or the load and the
    area of the ``"contact"`` too. None for any other. Gradients need it, or `pull_back`."""

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

        In the contact frame one state serves all positions of a cycle. A uniform state has no
        carrier. If two effects have a state of the same name, one on each body, laws and other
        effects read for each body the state on it; a single state of a case serves both bodies.
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
        """Return the factor on the normal load of the step that starts from a state; 1 by default.

        It is above 0, such as from a spring, a lever or a control, and held over the step, which is
        first-order accurate. The factors of several effects multiply each other.
        """
        return 1.0

    def pull_back(
        self, contact: ContactConditions, cotangents: Mapping[str, Mapping[str, Array]]
    ) -> Mapping[str, Array | float]:
        """Return the derivatives of a number in the inputs of `fields`: a vector-Jacobian product.

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
            An input that is left out has the derivative 0.
        """
        raise NotImplementedError

    def state_rates(self, contact: ContactConditions) -> Mapping[str, Array]:
        """Return the change of each state field per second.

        A change by sliding is a rate per metre times `contact.speed`, which is 0 while the motion
        rests; a relaxation in time continues at rest.

        Parameters
        ----------
        contact : ContactConditions
            The contact, with the depth rates of both bodies; its arrays must not be written to.

        Returns
        -------
        Mapping[str, ndarray]
            By field name; arrays that broadcast to (nx, ny), one number for a uniform field.
        """
        return {}
