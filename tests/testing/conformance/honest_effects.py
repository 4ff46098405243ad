"""Sound effects, some as the documentation has them, for mistakes to be made in."""

from typing import Annotated

import numpy as np
from testing.conformance.honest_laws import TEMPERATURE

from tribo import FRICTION_COEFFICIENT, LOAD_SHARE, LOCAL_SLIP, Effect, Field, Quantity

Part = Annotated[float, Quantity("1", at_least=0)]
Length = Annotated[float, Quantity("m", above=0)]
Duration = Annotated[float, Quantity("s", above=0)]
Kelvin = Annotated[float, Quantity("K", above=0)]


class Heating(Effect):
    """T = T0 + μ p v / c: heat goes through a film of conductance c, shared by the bodies."""

    type = "honest.heating"
    reach = "point"
    ambient: Kelvin = 293.0
    """Temperature T0 far away."""
    conductance: Annotated[float, Quantity("W/(m^2 K)", above=0)] = 1e5
    """Conductance c, of both bodies together."""
    delay: Duration = 30.0
    """Time over which it warms up."""

    requires = ("friction_coefficient",)
    provides = (
        TEMPERATURE,
        Field("friction_heat", "W/m^2", "Power of friction per area."),
        Field("friction_heat_slope", "m/s", "Derivative of the heat in pressure."),
    )

    def fields(self, contact):
        p, v, names = contact.pressure, contact.speed, list(contact.materials)
        grown = 1 - np.exp(-contact.time / self.delay)
        heat, steep, hot = {}, {}, {}
        for name, friction in contact.fields["friction_coefficient"].items():
            share = grown / len(names)
            heat[name] = share * (friction * p * v)
            steep[name] = share * friction * v
            hot[name] = self.ambient + heat[name] / self.conductance
        return {"temperature": hot, "friction_heat": heat, "friction_heat_slope": steep}


class Debris(Effect):
    """dt/ds = c (r1 + r2) - t/length; debris carries the part 1 - exp(-t/cover)."""

    type = "honest.debris"
    reach = "point"
    caught: Part = 0.8
    """Part c of what is worn that becomes debris."""
    length: Length = 0.5
    """Distance over which debris leaves."""
    cover: Length = 1e-6
    """Thickness that leaves 1/e of the pressure to the bodies."""

    state_fields = (Field("debris", "m", "Thickness of debris.", at_least=0.0),)
    provides = (LOAD_SHARE,)

    def source(self, contact):
        return self.caught * sum(contact.wear_rates.values())

    def share(self, contact):
        return -np.expm1(-contact.state["debris"] / self.cover)

    def fields(self, contact):
        return {"load_share": dict.fromkeys(contact.materials, self.share(contact))}

    def state_rates(self, contact):
        debris, source = contact.state["debris"], self.source(contact)
        leaving = np.where(contact.pressure > 0, debris / self.length, 0.0)
        return {"debris": contact.speed * (source - leaving)}


class Transfer(Debris):
    """What one body loses lies on the other as a film, moves with that and carries."""

    type = "honest.transfer"
    on: str = "disk"
    """Name of the body on which the film lies."""

    def carrier(self):
        return self.on

    def source(self, contact):
        lost = [rate for name, rate in contact.wear_rates.items() if name != self.on]
        return self.caught * sum(lost)


class Spreading(Effect):
    """dt/dt = v c (r1 + r2) + D (t_xx + t_yy) - v t/ℓ: debris spreads, and leaves at reversals."""

    type = "honest.spreading"
    caught: Part = 0.8
    """Part c of what is worn that becomes debris."""
    diffusivity: Annotated[float, Quantity("m^2/s", above=0)] = 1e-11
    """D, by which it spreads."""
    cover: Length = 1e-6
    """Thickness that leaves 1/e of the pressure to the bodies."""
    leaves: Part = 0.5
    """Part that leaves each time when the track has been passed."""

    state_fields = (Field("spread", "m", "Thickness of debris.", at_least=0.0),)
    provides = (LOAD_SHARE,)

    def fields(self, contact):
        share = -np.expm1(-contact.state["spread"] / self.cover)
        return {"load_share": dict.fromkeys(contact.materials, share)}

    def state_rates(self, contact):
        v, spread, (dx, dy) = contact.speed, contact.state["spread"], contact.grid.spacing
        t = np.pad(spread, 1, mode="edge")
        along = t[2:, 1:-1] - 2 * spread + t[:-2, 1:-1]
        across = t[1:-1, 2:] - 2 * spread + t[1:-1, :-2]
        curved = along / dx**2 + across / dy**2
        source = v * self.caught * sum(contact.wear_rates.values())
        leaving = v * self.leaves * spread / contact.track
        return {"spread": source + self.diffusivity * curved - leaving}


class Bath(Effect):
    """C dT/dt = friction's power - G (T - T0): one temperature of the oil, which thins it."""

    type = "honest.bath"
    reach = "contact"
    ambient: Kelvin = 300.0
    """Temperature T0 far away, and at first."""
    capacity: Annotated[float, Quantity("J/K", above=0)] = 50.0
    """Capacity C for heat."""
    conductance: Annotated[float, Quantity("W/K", above=0)] = 2.0
    """Heat G lost per kelvin."""
    thinning: Kelvin = 30.0
    """Rise of temperature that thins the oil to 1/e."""

    requires = ("friction_coefficient",)
    state_fields = (
        Field("bath_temperature", "K", "Temperature of the oil.", at_least=0.0, uniform=True),
    )
    provides = (Field("oil_share", "1", "Viscosity over that at first.", at_least=0.0),)

    def initial_state(self):
        return {"bath_temperature": self.ambient}

    def fields(self, contact):
        warmer = contact.state["bath_temperature"] - self.ambient
        thin = np.exp(-warmer / self.thinning)
        return {"oil_share": dict.fromkeys(contact.materials, thin)}

    def state_rates(self, contact):
        p, v, area = contact.pressure, contact.speed, contact.grid.cell_area
        friction = next(iter(contact.fields["friction_coefficient"].values()))
        power = np.sum(friction * p) * area * v
        lost = self.conductance * (contact.state["bath_temperature"] - self.ambient)
        return {"bath_temperature": (power - lost) / self.capacity}


class Tribofilm(Effect):
    """dc/dt = v (1 - c)/length under pressure, less c/life; the film has a friction of its own."""

    type = "honest.tribofilm"
    reach = "point"
    dry: Part = 0.5
    """Coefficient of friction of bare metal."""
    filmed: Part = 0.1
    """Coefficient of friction of the film."""
    length: Length = 2.0
    """Distance over which it forms."""
    life: Duration = 50.0
    """Time over which it fades."""

    state_fields = (Field("film", "1", "Part under film.", at_least=0.0, at_most=1.0),)
    provides = (FRICTION_COEFFICIENT,)

    def fields(self, contact):
        friction = self.dry + (self.filmed - self.dry) * contact.state["film"]
        return {"friction_coefficient": dict.fromkeys(contact.materials, friction)}

    def state_rates(self, contact):
        v, film = contact.speed, contact.state["film"]
        formed = v * (contact.pressure > 0) * (1 - film) / self.length
        faded = film / self.life
        return {"film": formed - faded}


class Flash(Effect):
    """T = T0 + μ W v / (8 a k), less on a body that moves, by its Péclet number."""

    type = "honest.flash"
    reach = "contact"
    ambient: Kelvin = 293.0
    """Temperature T0 far away."""
    conductivity: Annotated[float, Quantity("W/(m K)", above=0)] = 40.0
    """Conductivity k of both bodies."""
    diffusivity: Annotated[float, Quantity("m^2/s", above=0)] = 1e-5
    """Diffusivity of both bodies."""

    requires = ("friction_coefficient",)
    provides = (TEMPERATURE,)

    def fields(self, contact):
        p, v, (dx, dy) = contact.pressure, contact.speed, contact.grid.spacing
        load = np.sum(p) * dx * dy
        radius = np.sqrt(np.count_nonzero(p) * dx * dy / np.pi)
        slow = 1 / (1 + v * radius / self.diffusivity)
        hot = {}
        for name, friction in contact.fields["friction_coefficient"].items():
            cooled = slow if name in contact.swept else 1.0
            power = friction * load * v * cooled
            hot[name] = self.ambient + power / (8 * radius * self.conductivity)
        return {"temperature": hot}


class Slip(Effect):
    """A point slips the less the more the friction that holds it."""

    type = "honest.slip"
    reach = "point"
    strength: Annotated[float, Quantity("Pa", above=0)] = 3e8
    """Traction at which a point slips half of the way."""

    requires = ("friction_coefficient",)
    provides = (LOCAL_SLIP,)

    def slip(self, contact):
        friction = next(iter(contact.fields["friction_coefficient"].values()))
        return 1 / (1 + friction * contact.pressure / self.strength)

    def fields(self, contact):
        return {"local_slip": dict.fromkeys(contact.materials, self.slip(contact))}

    def pull_back(self, contact, cotangents):
        body, friction = next(iter(contact.fields["friction_coefficient"].items()))
        by = -sum(cotangents["local_slip"].values()) * self.slip(contact) ** 2 / self.strength
        return {
            "pressure": friction * by,
            f"fields.friction_coefficient.{body}": contact.pressure * by,
            "strength": -np.sum(friction * contact.pressure * by) / self.strength,
        }


class Spring(Effect):
    """A spring that relaxes as the bodies wear: F = F₀ − S h."""

    type = "honest.spring"
    relaxes: Annotated[float, Quantity("1/m", at_least=0)] = 1e4
    """Stiffness over the first load."""

    def load_factor(self, snapshot):
        return 1 - self.relaxes * sum(b.max_wear_depth for b in snapshot.measures.bodies.values())


EFFECTS = (Heating, Debris, Transfer, Spreading, Bath, Tribofilm, Flash, Slip, Spring)
