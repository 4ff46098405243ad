"""Materials, those known by name, and the contact modulus of two materials."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Annotated, Any

from pydantic import model_validator

from tribo.core.errors import CaseError, WrongValues, warn
from tribo.core.shorthand import call
from tribo.core.table import Table
from tribo.core.units import Quantity, quantities
from tribo.core.words import did_you_mean, said, suggestion

Poisson = Annotated[float, Quantity("1", above=-1, below=0.5, usual=(0, 0.5))]
"""Poisson's ratio; below 0 only foams and lattices made for it."""


_LISTED = "'tribo materials' lists all names"


class Material(Table):
    """An isotropic material; elastic, or elastic-perfectly-plastic with a hardness.

    A name alone stands for the numbers that are known by it, as ``"100Cr6"`` does; a table that
    lacks `young` or `poisson` has them from its name, other keys replace what is known.

    Examples
    --------
    >>> steel = tribo.Material(name="100Cr6", hardness="7 GPa")
    >>> steel.young, steel.hardness  # known by its name; given here
    (210000000000.0, 7000000000.0)
    """

    name: str | None = None
    """Name of the material; `tribo materials` lists known names."""
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
    """Further properties by name, as models of the case declare them."""

    @classmethod
    def hint(cls, info: object) -> str:
        """Return what it needs, as the end of a message."""
        return f"a name or a table with young and poisson is needed; {_LISTED}"

    @model_validator(mode="before")
    @classmethod
    def _by_name(cls, given: Any) -> Any:
        table = {"name": given} if isinstance(given, str) else given
        if not isinstance(table, Mapping) or {"young", "poisson"} <= table.keys():
            return table
        name = table.get("name")
        known = materials[name].model_dump(exclude_none=True) if isinstance(name, str) else {}
        return {**known, **table}

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


_MARKS = {key: mark for key, f in Material.model_fields.items() for mark in quantities(f)}


class Materials:
    """The materials that are known by name: tribo's own, and materials of packages.

    Examples
    --------
    >>> tribo.materials["100Cr6"].poisson
    0.3
    """

    def __getitem__(self, name: str) -> Material:
        name, known = self.known(name)
        numbers = {key: typical(key, known[key]) for key in known.keys() & _MARKS.keys()}
        return Material(name=name, **numbers)

    def __iter__(self) -> Iterator[str]:
        return iter(self.tables())

    def tables(self) -> dict[str, dict[str, Any]]:
        """Return the data of each material, as in files such as ``materials.toml``."""
        files = *call("materials"), Path(__file__).with_name("materials.toml")
        return {name: table for file in files for name, table in _read(file).items()}

    def known(self, name: str) -> tuple[str, dict[str, Any]]:
        """Return name and table of a material by one of its names; `CaseError` if none has it."""
        tables = self.tables()
        called = {a.casefold(): n for n, t in tables.items() for a in (n, *t.get("also", ()))}
        if found := called.get(name.casefold()):
            return found, tables[found]
        meant = suggestion(did_you_mean(name, [*tables, *called]))
        raise WrongValues(f"no material is called {name!r}{meant} {_LISTED}")


materials = Materials()
"""The materials that a case may name."""


def typical(key: str, number: Mapping[str, Any]) -> float:
    """Return the value of a number for a case: its value or the middle of its range."""
    given = [number["value"]] if "value" in number else number["range"]
    return sum(map(_MARKS[key].read, given)) / len(given)


def in_words(number: Mapping[str, Any]) -> str:
    """Return a number as its sources give it."""
    value, ends = number.get("value"), " to ".join(map(str, number.get("range", ())))
    return str(value) if not ends else ends if value is None else f"{ends}, {value} taken"


@cache
def _read(file: Path) -> dict[str, dict[str, Any]]:
    """Return the tables of a file, with sources in full; one of a package may be wrong."""
    try:
        tables = tomllib.loads(file.read_text(encoding="utf-8"))
        sources = tables.pop("sources")
        for number in (part for table in tables.values() for part in table.values()):
            if isinstance(number, dict):
                number["sources"] = [sources[each] for each in number["sources"].split()]
    except (OSError, ValueError, LookupError, AttributeError) as error:
        warn(f"{file} is left out: {said(error)}")
        return {}
    return tables
