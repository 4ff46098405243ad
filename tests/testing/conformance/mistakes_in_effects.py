"""Effects without a state and with mistakes, written without sight of the kit's source."""

from testing.conformance.honest_effects import Heating
from testing.conformance.mistaken import mistake

HEAT, GROWN = (
    "friction * contact.pressure * contact.speed",
    "1 - np.exp(-contact.time / self.delay)",
)
BODIES, AMBIENT = "/ len(contact.materials)", "self.ambient + heat"

for words, old, new in (
    ("The heat forgets the speed", HEAT, "friction * contact.pressure * 0.1"),
    ("The heat is that of a cell, not of an area", HEAT, f"{HEAT} * contact.grid.cell_area"),
    ("The heat is averaged over the window", HEAT, f"(np.mean({HEAT}) + 0 * contact.pressure)"),
    ("It warms up over 100 s, in the code", "self.delay", "100.0"),
    ("The ambient is converted to degrees Celsius", AMBIENT, "self.ambient - 273.15 + heat"),
    ("The ambient is taken off, not added", AMBIENT, "-self.ambient + heat"),
    (
        "The first body gets more heat",
        BODIES,
        "* (0.7 if name == next(iter(contact.materials)) else 0.3)",
    ),
    ("The ball gets more heat", BODIES, '* (0.7 if name == "ball" else 0.3)'),
    ("Cells at an index are hot", GROWN, "1.0 + (np.indices(contact.pressure.shape)[0] == 12)"),
    ("Where there is no heat, it divides 0 by 0", GROWN, "contact.pressure / contact.pressure"),
    ("The slope of the heat is the heat", "share * friction * contact.speed", "heat[name]"),
    ("The conductance is 1e5 W/(m² K), in the code", "/ self.conductance", "* 1e-5"),
):
    mistake(words, Heating, old, new)


def lagging(self, contact):
    now = Heating.fields(self, contact)
    before, self._before = self._before or now, now
    shape = contact.pressure.shape
    return {
        key: {
            n: 0.5 * v + 0.5 * (before[key][n] if before[key][n].shape == shape else v)
            for n, v in by.items()
        }
        for key, by in now.items()
    }


mistake("It remembers the temperature of its last call", Heating, _before=None, fields=lagging)
