"""Contact temperature from frictional heating: flash, bulk and heat partition."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Self

import numpy as np
from pydantic import BaseModel, ConfigDict, model_validator
from tribo import Array, CaseError, ContactConditions, Effect, Field, Material, Quantity

from tribo_thermal.sources import Profile, Rise, rise_per_power, source_radius

TEMPERATURE = Field(
    "temperature",
    "K",
    "Temperature of the body's surface in the contact.",
    at_least=0.0,
    typical=400.0,
)
RISE = Field("temperature_rise", "K", "The same above the ambient temperature.")


class HeatPath(BaseModel):
    """How heat leaves a body beyond the contact: a bar that ends at ambient temperature."""

    model_config = ConfigDict(extra="forbid", frozen=True, use_attribute_docstrings=True)

    length: Annotated[float, Quantity("m", at_least=0)]
    """Mean length l of the path to the heat sink."""
    area: Annotated[float, Quantity("m^2", above=0)]
    """Nominal cross-section A of the path."""


class Flash(Effect):
    """T = T₀ + r μ F v (R_flash + l/(A K)), with R_flash after Tian & Kennedy.

    The contact is a circular heat source of power μ F v, at rest on the
    stationary body (static) and moving at the sliding speed over the swept
    one; see `rise_per_power`. Each body adds the bulk resistance of its heat
    path, K/W. The parts r of the heat make the two temperatures equal (Blok's
    1/ΔT = 1/ΔT₁ + 1/ΔT₂, bulk included), unless the case gives them: then
    each body has its own temperature, as across an insulating film.

    The field is uniform over the contact, its mean or its maximum: it has no
    hot spots and no profile. It lags nothing: valid where the contact changes
    slowly beside a²/κ (milliseconds to a second), for strokes of many contact
    radii (reversals are neglected), a mean speed, properties that do not
    depend on temperature, and one body swept or none.

    References
    ----------
    Tian, X., Kennedy, F. E. (1994), J. Tribology 116, 167-174. Blok, H.
    (1937), Proc. General Discussion on Lubrication, IMechE 2, 222-235.
    Ashby, M. F., Abulawi, J., Kong, H. S. (1991), Temperature maps for
    frictional heating in dry sliding, Tribology Transactions 34, 577-587.
    """

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {"ambient": "90 degC"},
                {"ambient": "20 degC", "source": "parabolic", "rise": "maximum"},
            ]
        }
    )

    type = "thermal.flash"
    ambient: Annotated[float, Quantity("K", above=0)]
    """Temperature of the surroundings and of every heat sink."""
    source: Profile = "uniform"
    """How heat is spread over the contact: ``uniform``, as when worn, or ``parabolic``, as by
    Hertz."""
    rise: Rise = "mean"
    """Whether the temperature is the ``mean`` or the ``maximum`` over the contact."""
    heat_paths: dict[str, HeatPath] | None = None
    """Heat path of each body, by name; a body without one is a half-space at ambient."""
    heat_fraction: dict[str, Annotated[float, Quantity("1", at_least=0, at_most=1)]] | None = None
    """Part of the heat that each body takes, by name, in sum 1; by partition if left out."""

    @model_validator(mode="after")
    def _all_heat_goes_somewhere(self) -> Self:
        fractions = self.heat_fraction
        if fractions is not None and abs(sum(fractions.values()) - 1) > 1e-9:
            total = sum(fractions.values())
            raise ValueError(f"heat_fraction adds up to {total:g}; all the heat is 1")
        return self

    provides = (TEMPERATURE, RISE)
    requires = ("friction_coefficient",)

    def check(self, materials: Mapping[str, Material], swept: frozenset[str]) -> None:
        """Require thermal properties, bodies that exist, and one that stays in contact."""
        bodies = set(materials)
        fractions = self.heat_fraction
        paths = self.heat_paths or {}
        if not set(paths) <= bodies:
            raise CaseError(_which("heat_paths", paths, bodies))
        if fractions is not None and set(fractions) != bodies:
            raise CaseError(_which("heat_fraction", fractions, bodies))
        if swept >= bodies:
            raise CaseError(
                "'thermal.flash' needs a body that stays in the contact; here all are swept, at "
                "speeds it does not know"
            )
        for name, material in materials.items():
            _needed(name, material, "conductivity")
            if name in swept:
                _needed(name, material, "density")
                _needed(name, material, "heat_capacity")

    def fields(self, contact: ContactConditions) -> Mapping[str, Mapping[str, Array]]:
        """Return the temperature of each body and its rise, uniform over the contact."""
        rises = self.rises(contact)
        rise = {name: np.full((1, 1), value) for name, value in rises.items()}
        return {
            TEMPERATURE.name: {name: self.ambient + value for name, value in rise.items()},
            RISE.name: rise,
        }

    def rises(self, contact: ContactConditions) -> dict[str, float]:
        """Return how much hotter than ambient each body is in the contact, in K."""
        if not np.any(contact.pressure > 0):
            return dict.fromkeys(contact.materials, 0.0)
        friction = next(iter(contact.fields["friction_coefficient"].values()))
        traction = float(np.sum(friction * contact.pressure)) * contact.grid.cell_area
        power = traction * contact.speed
        resistance = {
            name: self._resistance(name, material, contact)
            for name, material in contact.materials.items()
        }
        fractions = self.heat_fraction
        if fractions is None:
            together = 1 / sum(1 / r for r in resistance.values())
            return dict.fromkeys(resistance, power * together)
        return {name: fractions[name] * power * r for name, r in resistance.items()}

    def _resistance(self, name: str, material: Material, contact: ContactConditions) -> float:
        conductivity = _needed(name, material, "conductivity")
        radius = source_radius(contact.pressure, contact.grid.cell_area, self.source)
        peclet = 0.0
        if name in contact.swept:
            capacity = _needed(name, material, "density") * _needed(name, material, "heat_capacity")
            peclet = contact.speed * radius * capacity / (2 * conductivity)
        flash = rise_per_power(radius, conductivity, peclet, self.source, self.rise)
        path = (self.heat_paths or {}).get(name)
        return flash if path is None else flash + path.length / (path.area * conductivity)


def _needed(name: str, material: Material, key: str) -> float:
    value = getattr(material, key)
    if value is None:
        raise CaseError(
            f"'thermal.flash' needs the {key.replace('_', ' ')} of {name!r}: add {key}",
            f"bodies.{name}.material.{key}",
        )
    return float(value)


def _which(key: str, given: Mapping[str, object], bodies: set[str]) -> str:
    return (
        f"'thermal.flash' has {key} for {', '.join(given)}; the bodies are "
        f"{', '.join(sorted(bodies))}"
    )
