"""Sound models, some as the documentation has them, for mistakes to be made in."""

from dataclasses import replace
from typing import Annotated, Any, ClassVar

import numpy as np

from tribo import (
    FRICTION_COEFFICIENT,
    LOAD_SHARE,
    WORN_DEPTH,
    ContactSolver,
    Effect,
    Field,
    Kinematics,
    Quantity,
    Stationary,
    Surface,
    Track,
    WearLaw,
    WearRate,
    solve_bounded,
)

GAS_CONSTANT = 8.314462618


class RunningIn(WearLaw):
    """dh/ds = k p, with k from k_first to k_last over a length."""

    type = "honest.running_in"
    k_first: Annotated[float, Quantity("1/Pa", at_least=0)] = 4e-16
    """Specific wear rate of a fresh point."""
    k_last: Annotated[float, Quantity("1/Pa", at_least=0)] = 1e-16
    """Specific wear rate once it has run in."""
    length: Annotated[float, Quantity("m", above=0)] = 2.0
    """Distance slid over which it runs in."""

    state_fields = (Field("slid", "m", "Distance slid under pressure.", at_least=0.0),)

    def k(self, local):
        share = np.exp(-local.state["slid"] / self.length)
        return self.k_last + (self.k_first - self.k_last) * share

    def slid(self, local):
        return (local.pressure > 0).astype(float)

    def rate(self, local):
        k = self.k(local)
        return WearRate(k * local.pressure, k, {"slid": self.slid(local)})


class Coating(WearLaw):
    """dh/ds = k p, with one k down to a depth and another below."""

    type = "honest.coating"
    k: Annotated[float, Quantity("1/Pa", at_least=0)] = 1e-16
    """Rate above."""
    below: Annotated[float, Quantity("1/Pa", at_least=0)] = 1e-15
    """Rate below."""
    thickness: Annotated[float, Quantity("m", above=0)] = 1e-6
    """Where it ends."""

    @property
    def state_fields(self):
        return (replace(WORN_DEPTH, breaks=(self.thickness,)),)

    def rate(self, local):
        k = np.where(local.state["worn_depth"] < self.thickness, self.k, self.below)
        return WearRate(k * local.pressure, k, {"worn_depth": k * local.pressure})


TEMPERATURE = Field(
    "temperature", "K", "Temperature of the surface.", at_least=0.0, at_most=1500.0, typical=400.0
)


class Oxide(WearLaw):
    """Bare metal wears by its temperature; oxide covers it and does not wear."""

    type = "honest.oxide"
    k_bare: Annotated[float, Quantity("1/Pa", at_least=0)] = 4e-16
    """Specific wear rate of bare metal at the reference temperature."""
    length: Annotated[float, Quantity("m", above=0)] = 5.0
    """Distance slid over which oxide covers it."""
    energy: Annotated[float, Quantity("J/mol", at_least=0)] = 8e3
    """Activation energy."""
    reference: Annotated[float, Quantity("K", above=0)] = 363.0
    """Reference temperature."""

    requires = ("temperature",)
    state_fields = (Field("cover", "1", "Part under oxide.", at_least=0.0, at_most=1.0),)

    def factor(self, local):
        warmer = 1 / local.fields["temperature"] - 1 / self.reference
        return np.exp(-self.energy / GAS_CONSTANT * warmer)

    def bare(self, local):
        return 1 - local.state["cover"]

    def grown(self, local):
        return (1 - local.state["cover"]) / self.length

    def rate(self, local):
        k = self.k_bare * self.factor(local) * self.bare(local)
        grown = np.where(local.pressure > 0, self.grown(local), 0.0)
        return WearRate(k * local.pressure, k, {"cover": grown})


class Heating(Effect):
    """T = T0 + μ p v / c: heat goes through a film of conductance c, shared by the bodies."""

    type = "honest.heating"
    reach = "point"
    ambient: Annotated[float, Quantity("K", above=0)] = 293.0
    """Temperature T0 far away."""
    conductance: Annotated[float, Quantity("W/(m^2 K)", above=0)] = 1e5
    """Conductance c, of both bodies together."""
    delay: Annotated[float, Quantity("s", above=0)] = 30.0
    """Time over which it warms up."""

    requires = ("friction_coefficient",)
    provides = (
        TEMPERATURE,
        Field("friction_heat", "W/m^2", "Power of friction per area."),
        Field("friction_heat_slope", "m/s", "Derivative of the heat in pressure."),
    )

    def base(self):
        return self.ambient

    def flux(self, contact, friction):
        return friction * contact.pressure * contact.speed

    def steep(self, contact, friction):
        return friction * contact.speed

    def grown(self, contact):
        return 1 - np.exp(-contact.time / self.delay)

    def share(self, name, names):
        return 1 / len(names)

    def rise(self, flux):
        return flux / self.conductance

    def fields(self, contact):
        names = list(contact.materials)
        heat, steep, hot = {}, {}, {}
        for name, friction in contact.fields["friction_coefficient"].items():
            share = self.share(name, names) * self.grown(contact)
            heat[name] = share * self.flux(contact, friction)
            steep[name] = share * self.steep(contact, friction)
            hot[name] = self.base() + self.rise(heat[name])
        return {"temperature": hot, "friction_heat": heat, "friction_heat_slope": steep}


class Debris(Effect):
    """dt/ds = c (r1 + r2) - t/length; debris carries the part 1 - exp(-t/cover)."""

    type = "honest.debris"
    reach = "point"
    caught: Annotated[float, Quantity("1", at_least=0)] = 0.8
    """Part c of what is worn that becomes debris."""
    length: Annotated[float, Quantity("m", above=0)] = 0.5
    """Distance over which debris leaves."""
    cover: Annotated[float, Quantity("m", above=0)] = 1e-6
    """Thickness that leaves 1/e of the pressure to the bodies."""

    state_fields = (Field("debris", "m", "Thickness of debris.", at_least=0.0),)
    provides = (LOAD_SHARE,)

    def source(self, contact):
        return self.caught * sum(contact.wear_rates.values())

    def leaving(self, contact):
        return np.where(contact.pressure > 0, contact.state["debris"] / self.length, 0.0)

    def share(self, contact):
        return -np.expm1(-contact.state["debris"] / self.cover)

    def fields(self, contact):
        return {"load_share": dict.fromkeys(contact.materials, self.share(contact))}

    def state_rates(self, contact):
        return {"debris": contact.speed * (self.source(contact) - self.leaving(contact))}


class Bath(Effect):
    """C dT/dt = friction's power - G (T - T0): one temperature of the oil, which thins it."""

    type = "honest.bath"
    reach = "contact"
    ambient: Annotated[float, Quantity("K", above=0)] = 300.0
    """Temperature T0 far away, and at first."""
    capacity: Annotated[float, Quantity("J/K", above=0)] = 50.0
    """Capacity C for heat."""
    conductance: Annotated[float, Quantity("W/K", above=0)] = 2.0
    """Heat G lost per kelvin."""
    thinning: Annotated[float, Quantity("K", above=0)] = 30.0
    """Rise of temperature that thins the oil to 1/e."""

    requires = ("friction_coefficient",)
    state_fields = (
        Field("bath_temperature", "K", "Temperature of the oil.", at_least=0.0, uniform=True),
    )
    provides = (Field("oil_share", "1", "Viscosity over that at first.", at_least=0.0),)

    def initial_state(self):
        return {"bath_temperature": self.ambient}

    def power(self, contact):
        friction = next(iter(contact.fields["friction_coefficient"].values()))
        return np.sum(friction * contact.pressure) * contact.grid.cell_area * contact.speed

    def lost(self, contact):
        return self.conductance * (contact.state["bath_temperature"] - self.ambient)

    def fields(self, contact):
        warmer = contact.state["bath_temperature"] - self.ambient
        thin = np.exp(-warmer / self.thinning)
        return {"oil_share": dict.fromkeys(contact.materials, thin)}

    def state_rates(self, contact):
        return {"bath_temperature": (self.power(contact) - self.lost(contact)) / self.capacity}


class Tribofilm(Effect):
    """dc/dt = v (1 - c)/length under pressure, less c/life; the film has a friction of its own."""

    type = "honest.tribofilm"
    reach = "point"
    dry: Annotated[float, Quantity("1", at_least=0)] = 0.5
    """Coefficient of friction of bare metal."""
    filmed: Annotated[float, Quantity("1", at_least=0)] = 0.1
    """That of the film."""
    length: Annotated[float, Quantity("m", above=0)] = 2.0
    """Distance over which it forms."""
    life: Annotated[float, Quantity("s", above=0)] = 50.0
    """Time over which it fades."""

    state_fields = (Field("film", "1", "Part under film.", at_least=0.0, at_most=1.0),)
    provides = (FRICTION_COEFFICIENT,)

    def formed(self, contact):
        bare = (contact.pressure > 0) * (1 - contact.state["film"])
        return contact.speed * bare / self.length

    def faded(self, contact):
        return contact.state["film"] / self.life

    def friction(self, contact):
        return self.dry + (self.filmed - self.dry) * contact.state["film"]

    def fields(self, contact):
        friction = self.friction(contact)
        return {"friction_coefficient": dict.fromkeys(contact.materials, friction)}

    def state_rates(self, contact):
        return {"film": self.formed(contact) - self.faded(contact)}


class Ramp(Kinematics):
    """The second body is drawn along a track, ever faster until it has its speed."""

    type = "honest.ramp"
    speed: Annotated[float, Quantity("m/s", above=0)] = 0.1
    """Speed in the end."""
    start: Annotated[float, Quantity("s", above=0)] = 5.0
    """Time until it has that."""
    track_length: Annotated[float, Quantity("m", above=0)] = 0.1
    """Length of the closed track."""
    duration: Annotated[float, Quantity("s", above=0)] = 100.0
    """How long it runs."""

    track: ClassVar[Any] = Track

    def takes(self):
        return self.start

    @property
    def end_time(self):
        return self.duration

    def distance_at(self, time):
        early = min(time, self.takes())
        return self.speed * (0.5 * early**2 / self.takes() + time - early)

    def exposures(self, grid, bodies):
        return {bodies[0]: Stationary(grid), bodies[1]: self.track(grid, self.track_length)}


class Wavy(Surface):
    """A wave along x."""

    type = "honest.wavy"
    amplitude: Annotated[float, Quantity("m", above=0)] = 1e-6
    """Amplitude of the wave."""
    wavelength: Annotated[float, Quantity("m", above=0)] = 2.5e-4
    """Its length."""

    def height(self, grid):
        x, y = grid.mesh
        return self.amplitude * np.sin(2 * np.pi * x / self.wavelength + 0.3) + 0 * y


class Springs:
    """Springs, one to a cell, as `solve_bounded` takes them."""

    def __init__(self, grid, stiffness):
        self.shape, self.spacing, self.stiffness = grid.cells, grid.spacing, stiffness

    def apply(self, pressure):
        return pressure / self.stiffness

    def symbol(self):
        nx, ny = self.shape
        return np.full((nx, ny // 2 + 1), 1 / self.stiffness)


class Pad(ContactSolver):
    """A soft pad, of stiffness modulus over thickness."""

    type = "honest.pad"
    modulus: Annotated[float, Quantity("Pa", above=0)] = 1e10
    """Modulus of the pad, under no strain along it."""
    thickness: Annotated[float, Quantity("m", above=0)] = 1e-4
    """Its thickness."""

    accepts_wear_compliance = True
    honours_cap = True

    def stiffness(self, grid):
        return self.modulus / self.thickness

    def solve(self, problem, start=None):
        grid, system = problem.system.grid, problem.system
        return solve_bounded(
            Springs(grid, self.stiffness(grid)),
            problem.gap,
            problem.load,
            system.cap,
            problem.wear,
            start=None if start is None else start.pressure,
            tolerance=1e-9,
        )


MODELS = (
    *(RunningIn, Coating, Oxide, Heating, Debris, Bath, Tribofilm),
    *(Ramp, Wavy, Pad),
)
