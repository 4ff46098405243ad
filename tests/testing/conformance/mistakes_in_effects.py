"""Effects without a state and with mistakes, written without sight of the kit's source."""

import numpy as np
from testing.conformance.mistaken import mistake
from testing.conformance.models import Heating


def heating(words, **parts):
    mistake(words, Heating, **parts)


heating("The heat forgets the speed", flux=lambda self, c, mu: mu * c.pressure * 0.1)
heating(
    "The heat is that of a cell, not of an area",
    flux=lambda self, c, mu: mu * c.pressure * c.speed * c.grid.cell_area,
)
heating(
    "The heat is averaged over the window",
    flux=lambda self, c, mu: np.mean(mu * c.pressure * c.speed) + 0 * c.pressure,
)
heating("It warms up over 100 s, in the code", grown=lambda self, c: 1 - np.exp(-c.time / 100.0))
heating("The ambient is converted to degrees Celsius", base=lambda self: self.ambient - 273.15)
heating("The ambient is taken off, not added", base=lambda self: -self.ambient)
heating(
    "The first body gets more heat",
    share=lambda self, name, names: 0.7 if name == names[0] else 0.3,
)
heating("The ball gets more heat", share=lambda self, name, names: 0.7 if name == "ball" else 0.3)
heating(
    "Cells at an index are hot", grown=lambda self, c: 1.0 + (np.indices(c.pressure.shape)[0] == 12)
)
heating("Where there is no heat, it divides 0 by 0", grown=lambda self, c: c.pressure / c.pressure)
heating("The slope of the heat is the heat", steep=lambda self, c, mu: mu * c.pressure * c.speed)


def lagging(self, contact):
    now = Heating.fields(self, contact)
    first = self._before is None
    before = now if first else self._before
    self._before = now
    shape = contact.pressure.shape
    return {
        key: {
            n: 0.5 * v + 0.5 * (before[key][n] if np.shape(before[key][n]) == shape else v)
            for n, v in by.items()
        }
        for key, by in now.items()
    }


heating("It remembers the temperature of its last call", _before=None, fields=lagging)
heating("The conductance is 1e5 W/(m² K), in the code", rise=lambda self, flux: flux * 1e-5)
