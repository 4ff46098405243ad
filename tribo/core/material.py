"""Materials, and the contact modulus of two of them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, Any

from tribo.core.errors import CaseError
from tribo.core.table import Table
from tribo.core.units import Quantity

Poisson = Annotated[float, Quantity("1", above=-1, below=0.5, usual=(0, 0.5))]
"""Poisson's ratio; below 0 only foams and lattices made for it."""


class Material(Table):
    """An isotropic material; elastic, or elastic-perfectly-plastic with a hardness."""

    young: Annotated[float, Quantity("Pa", above=0, usual=(1e4, 2e12))]
    """Young's modulus E."""
    poisson: Poisson
    """Poisson's ratio."""
    hardness: Annotated[float, Quantity("Pa", above=0, usual=(1e4, 2e11))] | None = None
    """Hardness: the largest contact pressure it bears. Without one it stays elastic."""
    density: Annotated[float, Quantity("kg/m^3", above=0, usual=(10.0, 3e4))] | None = None
    """Density, with which worn volume is also given as mass."""
    conductivity: Annotated[float, Quantity("W/(m K)", above=0, usual=(1e-3, 5e3))] | None = None
    """Thermal conductivity."""
    heat_capacity: Annotated[float, Quantity("J/(kg K)", above=0, usual=(50.0, 2e4))] | None = None
    """Specific heat capacity."""
    properties: dict[str, Any] | None = None
    """Further properties by name, those that models of the case declare."""

    def property(self, name: str) -> float:
        """Return a property in SI: one of `properties`, or the value of a key such as ``density``.

        A model that declares it in its `material_properties` finds it given.
        """
        value = {**dict(self), **(self.properties or {})}.get(name)
        if value is None:
            raise CaseError(f"the material has no {name!r}; whoever reads it has to declare it")
        return float(value)


def contact_modulus(materials: Iterable[Material]) -> float:
    """Return the contact modulus E* of bodies in contact, in Pa.

    1/E* = Σ (1 − ν²)/E; Johnson, K. L. (1985), Contact Mechanics, eq. 4.22.
    """
    return 1 / sum((1 - m.poisson**2) / m.young for m in materials)
