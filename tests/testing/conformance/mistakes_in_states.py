"""Effects that remember, with mistakes in what they remember and in how it moves."""

import numpy as np
from testing.conformance.mistaken import mistake
from testing.conformance.models import Bath, Debris, Tribofilm

# Debris that wear feeds and sliding ejects.


def debris(words, rate=None, **parts):
    """Keep debris of which parts, or the rate of the thickness, are wrong."""
    if rate is not None:
        parts["state_rates"] = lambda self, contact: {"debris": rate(self, contact)}
    mistake(words, Debris, **parts)


debris(
    "Debris leaves per second, not per metre",
    lambda self, c: c.speed * self.source(c) - self.leaving(c),
)
debris("Debris moves per metre, not per second", lambda self, c: self.source(c) - self.leaving(c))
debris("Debris that leaves is added", lambda self, c: c.speed * (self.source(c) + self.leaving(c)))
debris("Wear takes debris away", lambda self, c: -c.speed * (self.source(c) + self.leaving(c)))
debris(
    "The rate of debris is its change in a step of 1 ms",
    lambda self, c: 1e-3 * c.speed * (self.source(c) - self.leaving(c)),
)
debris(
    "Debris moves at 1 mm/s at the least, at rest too",
    lambda self, c: max(c.speed, 1e-3) * (self.source(c) - self.leaving(c)),
)
debris(
    "The wear of the body called ball becomes debris",
    source=lambda self, c: self.caught * c.wear_rates["ball"],
)
debris(
    "The wear of the first body becomes debris",
    source=lambda self, c: 2 * self.caught * next(iter(c.wear_rates.values())),
)
debris(
    "Debris carries in proportion to its thickness, beyond all the load",
    share=lambda self, c: c.state["debris"] / self.cover,
)
debris(
    "Debris of 1 µm covers, in the code", share=lambda self, c: -np.expm1(-c.state["debris"] / 1e-6)
)
debris("Debris lies on the body called disk", carrier=lambda self: "disk")
debris(
    "Debris carries by the mean thickness of the window",
    share=lambda self, c: -np.expm1(-np.mean(c.state["debris"]) / self.cover) + 0 * c.pressure,
)
debris(
    "Debris carries at the next point, and is said to reach none",
    share=lambda self, c: -np.expm1(-np.roll(c.state["debris"], 1, axis=0) / self.cover),
)
debris(
    "The debris that wear is just making carries too",
    share=lambda self, c: (
        -np.expm1(-(c.state["debris"] + self.length * self.source(c)) / self.cover)
    ),
)


def moved_in_place(self, contact):
    thickness = contact.state["debris"]
    thickness += 0.01 * contact.speed * (self.source(contact) - self.leaving(contact))
    return 0 * thickness


debris("Debris is moved by the effect itself", moved_in_place)


def thickness_kept(self, contact):
    if self._thickness is None:
        self._thickness = contact.state["debris"]
    self._thickness = self._thickness + 1e-3 * self.source(contact)
    return contact.speed * (self.source(contact) - self._thickness / self.length)


debris("An object keeps the debris that it has seen", thickness_kept, _thickness=None)

# One temperature of a bath of oil.


def bath(words, **parts):
    mistake(words, Bath, **parts)


bath(
    "The bath's heat is that of an area",
    power=lambda self, c: Bath.power(self, c) / c.grid.cell_area,
)
bath(
    "The bath's heat is the mean of the window",
    power=lambda self, c: np.mean(c.pressure) * 1e-7 * c.speed * self.conductance * self.thinning,
)
bath("Heat that the bath loses warms it", lost=lambda self, c: -Bath.lost(self, c))
bath(
    "The bath begins at 20 °C, in the code",
    initial_state=lambda self: {"bath_temperature": 293.15},
)
bath(
    "The bath begins in degrees Celsius",
    initial_state=lambda self: {"bath_temperature": self.ambient - 273.15},
)
bath(
    "A uniform temperature changes at each point",
    power=lambda self, c: Bath.power(self, c) * c.pressure / np.max(c.pressure),
)
bath("Friction does not heat the bath", power=lambda self, c: 0.0)
bath(
    "The bath's heat is divided by the speed, also at rest",
    power=lambda self, c: Bath.power(self, c) * (c.speed / c.speed),
)
bath(
    "Oil thins by 30 K, in the code",
    fields=lambda self, c: {
        "oil_share": dict.fromkeys(
            c.materials, np.exp((self.ambient - c.state["bath_temperature"]) / 30.0)
        )
    },
)

# A film that forms by sliding and fades in time.


def tribofilm(words, **parts):
    mistake(words, Tribofilm, **parts)


tribofilm(
    "The film forms further where it is whole",
    formed=lambda self, c: c.speed * (c.pressure > 0) / self.length,
    faded=lambda self, c: 0 * c.pressure,
)
tribofilm(
    "The film forms per second",
    formed=lambda self, c: (c.pressure > 0) * (1 - c.state["film"]) / self.length,
)
tribofilm("The film fades over 50 s, in the code", faded=lambda self, c: c.state["film"] / 50.0)
tribofilm(
    "The film fades although there is none",
    faded=lambda self, c: 1 / self.life + 0 * c.state["film"],
)


def by_the_first_hardness(self, contact):
    first, second = (material.hardness for material in contact.materials.values())
    return Tribofilm.formed(self, contact) * first / (first + second)


tribofilm("The film forms by the hardness of the first body", formed=by_the_first_hardness)
tribofilm("The film never forms", formed=lambda self, c: 0 * c.pressure, faded=lambda self, c: 0.0)
tribofilm("Friction does not follow the film", friction=lambda self, c: self.dry + 0 * c.pressure)
tribofilm(
    "More film than half makes friction negative",
    friction=lambda self, c: self.dry * (1 - 2 * c.state["film"]) + self.filmed * c.state["film"],
)
tribofilm(
    "The film forms by fresh random numbers",
    formed=lambda self, c: (
        Tribofilm.formed(self, c) * np.random.default_rng().uniform(0.9, 1.1, c.pressure.shape)
    ),
)
