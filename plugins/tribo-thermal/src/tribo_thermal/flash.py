"""Contact temperature from frictional heating: flash, bulk and heat partition."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from typing import Annotated, Self

import numpy as np
from pydantic import BaseModel, ConfigDict, model_validator
from tribo import (
    Array,
    CaseError,
    ContactConditions,
    ContactSystem,
    Effect,
    Field,
    Quantity,
)

from tribo_thermal.sources import (
    Profile,
    Rise,
    kept_per_power,
    rise_per_power,
    source_radius,
)

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

    length: Annotated[float, Quantity("m", at_least=0, usual=(1e-6, 1.0))]
    """Mean length l of the path to the heat sink."""
    area: Annotated[float, Quantity("m^2", above=0, usual=(1e-10, 1.0))]
    """Nominal cross-section A of the path."""
    capacity: Annotated[float, Quantity("J/K", above=0, usual=(1e-6, 1e5))] | None = None
    """Heat capacity C of the body: its bulk warms with time. At once if left out."""

    @model_validator(mode="after")
    def _time_to_warm(self) -> Self:
        if self.capacity is not None and self.length == 0:
            raise ValueError("a capacity needs a length: without one the bulk stays at ambient")
        return self

    def resistance(self, conductivity: float) -> float:
        """Return l/(A K), in K/W."""
        return self.length / (self.area * conductivity)


class Flash(Effect):
    """T = T₀ + q (R_flash + R_kept + l/(A K)), with R_flash after Tian & Kennedy, q from μ F v.

    The contact is a circular heat source of power μ F v, at rest on the
    stationary body (static) and moving at the sliding speed over the swept
    one; see `rise_per_power`. R_kept is the heat that earlier passes left in
    the track of the swept body, to and fro or round; see `kept_per_power`. Each
    body adds the bulk resistance of its heat path, K/W. The heat flows q, which
    add up to μ F v, make the two temperatures equal (Blok's 1/ΔT = 1/ΔT₁ + 1/ΔT₂,
    bulk included), unless the case gives their parts: then each body has its
    own temperature, as across an insulating film.

    A body with a heat capacity C warms in time: its bulk is B above ambient,
    C dB/dt = q − B A K/l, a state that the result keeps and a rest lets cool,
    and T = T₀ + B + q (R_flash + R_kept). Two bodies of which one is hotter heat the other.

    The field is uniform over the contact, its mean or its maximum: it has no
    hot spots and no profile. It is the mean over a cycle: along a stroke the
    rise is up to 20 % above and below. It lags nothing: valid where the contact
    changes slowly beside a²/κ (milliseconds to a second), once a track of the
    length ℓ has been heated for some ℓ²/κ (0.3 s for 2 mm of steel, 3 min for
    50 mm), for strokes of two contact radii and more, a steady speed (of a
    sinusoidal stroke R_kept is a fifth too large), properties that do not
    depend on temperature, and one body swept or none. A swept body is a
    half-space also where it turns, as a ring does.

    References
    ----------
    Tian, X., Kennedy, F. E. (1994), J. Tribology 116, 167-174. Blok, H.
    (1937), Proc. General Discussion on Lubrication, IMechE 2, 222-235.
    Ashby, M. F., Abulawi, J., Kong, H. S. (1991), Temperature maps for
    frictional heating in dry sliding, Tribology Transactions 34, 577-587.

    Examples
    --------
    >>> from tribo_thermal.flash import Flash
    >>> steel = dict.fromkeys(("ball", "disk"), tribo.materials["100Cr6"])
    >>> system = tribo.ContactSystem(tribo.Grid("0.1 mm", 4), 115e9, load=10.0, materials=steel)
    >>> fields = {"friction_coefficient": dict.fromkeys(steel, np.full((1, 1), 0.3))}
    >>> pressure, swept = np.full((4, 4), 1e9), frozenset({"disk"})
    >>> contact = tribo.ContactConditions(system, pressure, 1.0, 0.0, 0.0, swept, fields=fields)
    >>> {name: round(rise) for name, rise in Flash(ambient=293).rises(contact).items()}  # in K
    {'ball': 99, 'disk': 99}
    """

    examples = (
        {"ambient": "90 degC"},
        {"ambient": "20 degC", "source": "parabolic", "rise": "maximum"},
    )
    type = "thermal.flash"
    reach = "contact"
    ambient: Annotated[float, Quantity("K", above=0, usual=(150.0, 2000.0))]
    """Temperature of the surroundings and of every heat sink."""
    source: Profile = "uniform"
    """How heat is spread over the contact: ``uniform``, as when worn, or ``parabolic``, as by
    Hertz."""
    rise: Rise = "mean"
    """Whether the temperature is the ``mean`` or the ``maximum`` over the contact."""
    heat_paths: dict[str, HeatPath] | None = None
    """Heat path of each body, by name; a body without one is a half-space at ambient."""
    heat_fraction: dict[str, Annotated[float, Quantity("1", at_least=0, at_most=1)]] | None = None
    """Part of the heat that each body takes, by name; the parts add up to 1. If left out, by
    partition."""

    @model_validator(mode="after")
    def _all_heat_goes_somewhere(self) -> Self:
        fractions = self.heat_fraction
        if fractions is not None and abs(sum(fractions.values()) - 1) > 1e-9:
            total = sum(fractions.values())
            raise ValueError(f"heat_fraction adds up to {total:g}; all the heat is 1")
        return self

    provides = (TEMPERATURE, RISE)
    requires = ("friction_coefficient",)
    material_properties = (Field("conductivity", "W/(m K)", "Thermal conductivity.", typical=46.0),)

    @property
    def _warming(self) -> dict[str, HeatPath]:
        """Paths of the bodies that warm in time."""
        paths = (self.heat_paths or {}).items()
        return {name: path for name, path in paths if path.capacity is not None}

    @property
    def state_fields(self) -> tuple[Field, ...]:  # type: ignore[override]
        """The bulk of each body that warms in time."""
        return tuple(
            Field(
                bulk(name),
                "K",
                f"Temperature of {name} beyond the contact, above ambient.",
                at_least=0.0,
                typical=10.0,
                uniform=True,
            )
            for name in self._warming
        )

    def check(self, system: ContactSystem, swept: frozenset[str], solver: str) -> None:
        """Require thermal properties, existing bodies, and a body that stays in contact."""
        materials = system.materials
        bodies = set(materials)
        for key, wrong in (
            ("heat_paths", set(self.heat_paths or {}) - bodies),
            ("heat_fraction", bodies ^ set(self.heat_fraction or bodies)),
        ):
            if wrong:
                raise CaseError(
                    f"'thermal.flash' has {key} for {', '.join(getattr(self, key))}; the bodies "
                    f"are {', '.join(sorted(bodies))}"
                )
        if swept >= bodies:
            raise CaseError(
                "'thermal.flash' needs a stationary body, and all bodies are swept; leave it out, "
                "or use a motion that sweeps one body"
            )
        for name, key in product(swept, ("density", "heat_capacity")):
            if getattr(materials[name], key) is None:
                raise CaseError(
                    f"'thermal.flash' needs the {key.replace('_', ' ')} of {name!r}: add {key}",
                    f"bodies.{name}.material.{key}",
                )

    def fields(self, contact: ContactConditions) -> Mapping[str, Mapping[str, Array]]:
        """Return the temperature of each body and its rise, uniform over the contact."""
        rises = self.rises(contact)
        rise = {name: np.full((1, 1), value) for name, value in rises.items()}
        return {
            TEMPERATURE.name: {name: self.ambient + value for name, value in rise.items()},
            RISE.name: rise,
        }

    def state_rates(self, contact: ContactConditions) -> Mapping[str, Array]:
        """Return the bulk temperature rate, in K/s, of each body that warms in time."""
        flows, rates = self._flows(contact), {}
        for name, path in self._warming.items():
            assert path.capacity is not None
            conductivity = contact.materials[name].property("conductivity")
            away = contact.state[bulk(name)] / path.resistance(conductivity)
            rates[bulk(name)] = (flows[name] - away) / path.capacity
        return rates

    def rises(self, contact: ContactConditions) -> dict[str, float]:
        """Return the temperature rise of each body in the contact above ambient, in K."""
        flows = self._flows(contact)
        return {
            name: self._bulk(name, contact) + flows[name] * self._resistance(name, contact)
            for name in contact.materials
        }

    def _flows(self, contact: ContactConditions) -> dict[str, float]:
        """Return the heat that flows into each body, in W."""
        if not np.any(contact.pressure > 0):
            return dict.fromkeys(contact.materials, 0.0)
        friction = next(iter(contact.fields["friction_coefficient"].values()))
        traction = float(np.sum(friction * contact.pressure)) * contact.grid.cell_area
        power = traction * contact.speed
        if self.heat_fraction is not None:
            return {name: part * power for name, part in self.heat_fraction.items()}
        bulks = {name: self._bulk(name, contact) for name in contact.materials}
        resistance = {name: self._resistance(name, contact) for name in contact.materials}
        together = 1 / sum(1 / r for r in resistance.values())
        common = together * (power + sum(bulks[name] / r for name, r in resistance.items()))
        return {name: (common - bulks[name]) / r for name, r in resistance.items()}

    def _bulk(self, name: str, contact: ContactConditions) -> float:
        """Return the bulk temperature rise of a body that warms in time, in K."""
        return float(contact.state[bulk(name)][0, 0]) if bulk(name) in contact.state else 0.0

    def _resistance(self, name: str, contact: ContactConditions) -> float:
        """Return the temperature per heat flow, in K/W, above the bulk that warms in time."""
        if not np.any(contact.pressure > 0):
            return 0.0
        material = contact.materials[name]
        conductivity = material.property("conductivity")
        radius = source_radius(contact.pressure, contact.grid.cell_area, self.source)
        peclet = 0.0
        if name in contact.swept:
            capacity = material.property("density") * material.property("heat_capacity")
            peclet = contact.speed * radius * capacity / (2 * conductivity)
        flash = rise_per_power(radius, conductivity, peclet, self.source, self.rise)
        flash += kept_per_power(radius, conductivity, peclet, contact.track, contact.turns_back)
        path = (self.heat_paths or {}).get(name)
        at_once = path is not None and path.capacity is None
        return flash + path.resistance(conductivity) if path and at_once else flash


def bulk(name: str) -> str:
    """Return the name of the state that is the temperature of a body beyond the contact."""
    return f"bulk_rise_{name}"
