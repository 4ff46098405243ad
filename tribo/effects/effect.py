"""The interface of effects: fields between the bodies, such as a temperature."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from typing import ClassVar

from tribo.component import Component
from tribo.core.arrays import Array
from tribo.core.fields import ContactConditions, Field
from tribo.core.material import Material


class Effect(Component):
    """Derives local fields, such as a temperature, from the solved contact.

    Effects run after the contact is solved and cannot alter load or gap. An
    implicit step evaluates them anew in each of its passes.
    """

    provides: ClassVar[tuple[Field, ...]]
    """The fields it answers with."""

    requires: ClassVar[tuple[str, ...]] = ()
    """Names of the fields it needs from effects before it, or from the case."""

    def check(self, materials: Mapping[str, Material], swept: frozenset[str]) -> None:
        """Raise `CaseError` if the effect cannot serve these bodies.

        Parameters
        ----------
        materials : Mapping[str, Material]
            The bodies' materials, by name.
        swept : frozenset of str
            Names of the bodies whose points pass through the contact.
        """

    @abstractmethod
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
