"""Sound models of the contact as a whole, and laws and a motion that go with them."""

import math
from dataclasses import replace
from typing import Annotated

import numpy as np
from testing.conformance.models import TEMPERATURE

from tribo import (
    LOAD_SHARE,
    LOCAL_SLIP,
    Archard,
    Effect,
    Field,
    Kinematics,
    ModifiedLaw,
    Position,
    Quantity,
    Stationary,
    Track,
    WearLaw,
    WearRate,
)


class Incubation(WearLaw):
    """dh/ds = k p once a point has slid a length, and k_early p before."""

    type = "honest.incubation"
    k_early: Annotated[float, Quantity("1/Pa", at_least=0)] = 1e-17
    """Specific wear rate at first."""
    k: Annotated[float, Quantity("1/Pa", at_least=0)] = 3e-16
    """Specific wear rate afterwards."""
    length: Annotated[float, Quantity("m", above=0)] = 4.0
    """Distance slid at which cracks have come to the surface."""

    @property
    def state_fields(self):
        return (Field("cracked", "m", "Distance slid.", at_least=0.0, breaks=(self.length,)),)

    def factor(self, local):
        return np.where(local.state["cracked"] < self.length, self.k_early, self.k)

    def rate(self, local):
        k = self.factor(local)
        return WearRate(k * local.pressure, k, {"cracked": (local.pressure > 0).astype(float)})


class Lubricated(ModifiedLaw):
    """dh/ds = r(p - p_film), with r another law, and a film that is rubbed off."""

    type = "honest.lubricated"
    law: WearLaw = Archard(k=2e-16)
    """The law that wears under the rest of the pressure."""
    p_film: Annotated[float, Quantity("Pa", at_least=0)] = 3e8
    """Pressure that the film carries at first."""
    length: Annotated[float, Quantity("m", above=0)] = 6.0
    """Distance over which 1/e of the film is left."""

    own_state = (Field("film_left", "1", "Part of the film left.", at_least=0.0, at_most=1.0),)

    def initial_state(self):
        return {**self.law.initial_state(), "film_left": 1.0}

    def left(self, local):
        return local.state["film_left"]

    def rubbed(self, local):
        return np.where(local.pressure > 0, -self.left(local) / self.length, 0.0)

    def rate(self, local):
        excess = np.maximum(local.pressure - self.p_film * self.left(local), 0.0)
        rate = self.law.rate(replace(local, pressure=excess))
        slope = rate.depth_slope * (excess > 0)
        states = {**rate.state_rates, "film_left": self.rubbed(local)}
        return replace(rate, depth_slope=slope, state_rates=states)


class Flash(Effect):
    """T = T0 + μ W v / (4 a k), less on a body that moves, by its Péclet number."""

    type = "honest.flash"
    reach = "contact"
    ambient: Annotated[float, Quantity("K", above=0)] = 293.0
    """Temperature T0 far away."""
    conductivity: Annotated[float, Quantity("W/(m K)", above=0)] = 40.0
    """Conductivity k of both bodies."""
    diffusivity: Annotated[float, Quantity("m^2/s", above=0)] = 1e-5
    """Diffusivity of both bodies."""

    requires = ("friction_coefficient",)
    provides = (TEMPERATURE,)

    def load(self, contact):
        return np.sum(contact.pressure) * contact.grid.cell_area

    def radius(self, contact):
        return np.sqrt(np.count_nonzero(contact.pressure) * contact.grid.cell_area / np.pi)

    def cooled(self, name, contact):
        peclet = contact.speed * self.radius(contact) / self.diffusivity
        return 1 / (1 + peclet) if name in contact.swept else 1.0

    def fields(self, contact):
        hot = {}
        for name in contact.materials:
            friction = contact.fields["friction_coefficient"][name]
            power = friction * self.load(contact) * contact.speed * self.cooled(name, contact)
            hot[name] = self.ambient + power / (8 * self.radius(contact) * self.conductivity)
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


class Spreading(Effect):
    """dt/dt = v c (r1 + r2) + D (t_xx + t_yy) - v t/ℓ: debris spreads, and leaves at reversals."""

    type = "honest.spreading"
    reach = (1, 1)
    caught: Annotated[float, Quantity("1", at_least=0)] = 0.8
    """Part c of what is worn that becomes debris."""
    diffusivity: Annotated[float, Quantity("m^2/s", above=0)] = 1e-11
    """D, by which it spreads."""
    cover: Annotated[float, Quantity("m", above=0)] = 1e-6
    """Thickness that leaves 1/e of the pressure to the bodies."""
    leaves: Annotated[float, Quantity("1", at_least=0)] = 0.5
    """Part that leaves each time when the track has been passed."""

    state_fields = (Field("spread", "m", "Thickness of debris.", at_least=0.0),)
    provides = (LOAD_SHARE,)

    def curved(self, contact):
        t, (dx, dy) = np.pad(contact.state["spread"], 1, mode="edge"), contact.grid.spacing
        along = t[2:, 1:-1] - 2 * t[1:-1, 1:-1] + t[:-2, 1:-1]
        across = t[1:-1, 2:] - 2 * t[1:-1, 1:-1] + t[1:-1, :-2]
        return along / dx**2 + across / dy**2

    def leaving(self, contact):
        return contact.speed * self.leaves * contact.state["spread"] / contact.track

    def fields(self, contact):
        share = -np.expm1(-contact.state["spread"] / self.cover)
        return {"load_share": dict.fromkeys(contact.materials, share)}

    def state_rates(self, contact):
        source = contact.speed * self.caught * sum(contact.wear_rates.values())
        spreads = self.diffusivity * self.curved(contact)
        return {"spread": source + spreads - self.leaving(contact)}


class Transfer(Effect):
    """What one body loses lies on the other as a film, moves with that and carries."""

    type = "honest.transfer"
    reach = "point"
    on: str = "disk"
    """Name of the body on which the film lies."""
    length: Annotated[float, Quantity("m", above=0)] = 0.5
    """Distance over which 1/e of it stays."""
    cover: Annotated[float, Quantity("m", above=0)] = 1e-6
    """Thickness that leaves 1/e of the pressure to the bodies."""

    state_fields = (Field("transferred", "m", "Thickness of the film.", at_least=0.0),)
    provides = (LOAD_SHARE,)

    def carrier(self):
        return self.on

    def source(self, contact):
        return sum(rate for name, rate in contact.wear_rates.items() if name != self.on)

    def leaving(self, contact):
        return np.where(contact.pressure > 0, contact.state["transferred"] / self.length, 0.0)

    def share(self, contact):
        return -np.expm1(-contact.state["transferred"] / self.cover)

    def fields(self, contact):
        return {"load_share": dict.fromkeys(contact.materials, self.share(contact))}

    def state_rates(self, contact):
        rate = self.source(contact) - self.leaving(contact)
        return {"transferred": contact.speed * rate}


class Shuttle(Kinematics):
    """Back and forth at a constant speed, with a rest at each end of the stroke."""

    type = "honest.shuttle"
    turns_back = True
    stroke: Annotated[float, Quantity("m", above=0)] = 3e-3
    """Length of the stroke."""
    speed: Annotated[float, Quantity("m/s", above=0)] = 0.06
    """Speed along it."""
    rest: Annotated[float, Quantity("s", above=0)] = 0.02
    """Time at rest at each end."""
    duration: Annotated[float, Quantity("s", above=0)] = 100.0
    """How long it runs."""
    swept: str | None = None
    """The body that is moved, the last if left out."""

    @property
    def end_time(self):
        return self.duration

    @property
    def track_extent(self):
        return self.stroke

    @property
    def moves(self):
        return self.stroke / self.speed

    def distance_at(self, time):
        strokes, into = divmod(time, self.moves + self.rest)
        return self.stroke * (strokes + min(into / self.moves, 1.0))

    def time_at(self, distance):
        # The whole strokes before, of which the last is not yet over at a reversal.
        strokes = max(math.ceil(distance / self.stroke - 1e-9) - 1, 0)
        return strokes * self.rest + distance / self.speed

    def cycle(self, grid):
        return [Position(speeds=self.speeds(), rest=self.rest / self.stroke)]

    def speeds(self):
        return [(self.speed, 1.0)]

    def exposures(self, grid, bodies):
        swept = bodies[-1] if self.swept is None else self.swept
        track = Track(grid, self.stroke)
        return {name: track if name == swept else Stationary(grid) for name in bodies}


MODELS = (Incubation, Lubricated, Flash, Slip, Spreading, Transfer, Shuttle)
