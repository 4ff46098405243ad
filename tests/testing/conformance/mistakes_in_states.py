"""Effects that remember, with mistakes in what they remember and in how it moves."""

from testing.conformance.honest_effects import Bath, Debris, Tribofilm
from testing.conformance.mistaken import mistake

# Debris that wear feeds and sliding ejects.

RATE, SUM = "contact.speed * (self.source(contact) - leaving)", "sum(contact.wear_rates.values())"
STATE = 'contact.state["debris"] / self.cover'
SHARE, SOURCE = f"-np.expm1(-{STATE})", "self.source(contact)"

for words, old, new in (
    ("Debris leaves per second, not per metre", RATE, f"contact.speed * {SOURCE} - leaving"),
    ("Debris moves per metre, not per second", RATE, f"{SOURCE} - leaving"),
    ("Debris that leaves is added", RATE, f"contact.speed * ({SOURCE} + leaving)"),
    ("Wear takes debris away", RATE, f"-contact.speed * ({SOURCE} + leaving)"),
    ("The rate of debris is its change in a step of 1 ms", RATE, f"1e-3 * {RATE}"),
    (
        "Debris moves at 1 mm/s at the least, at rest too",
        "contact.speed * (",
        "max(contact.speed, 1e-3) * (",
    ),
    ("The wear of the body called ball becomes debris", SUM, 'contact.wear_rates["ball"]'),
    (
        "The wear of the first body becomes debris",
        SUM,
        "2 * next(iter(contact.wear_rates.values()))",
    ),
    ("Debris carries in proportion to its thickness, beyond all the load", SHARE, STATE),
    ("Debris of 1 µm covers, in the code", "/ self.cover", "/ 1e-6"),
    (
        "Debris carries by the mean thickness of the window",
        SHARE,
        '-np.expm1(-np.mean(contact.state["debris"]) / self.cover) + 0 * contact.pressure',
    ),
    (
        "Debris carries at the next point, and is said to reach none",
        f"-{STATE}",
        '-np.roll(contact.state["debris"], 1, axis=0) / self.cover',
    ),
    (
        "The debris that wear is just making carries too",
        f"-{STATE}",
        f'-(contact.state["debris"] + self.length * {SOURCE}) / self.cover',
    ),
):
    mistake(words, Debris, old, new)
mistake("Debris lies on the body called disk", Debris, carrier=lambda self: "disk")


def moved_in_place(self, contact):
    thickness = contact.state["debris"]
    thickness += 0.01 * Debris.state_rates(self, contact)["debris"]
    return {"debris": 0 * thickness}


mistake("Debris is moved by the effect itself", Debris, state_rates=moved_in_place)


def thickness_kept(self, contact):
    if self._thickness is None:
        self._thickness = contact.state["debris"]
    self._thickness = self._thickness + 1e-3 * self.source(contact)
    return {"debris": contact.speed * (self.source(contact) - self._thickness / self.length)}


mistake(
    "An object keeps the debris that it has seen",
    Debris,
    _thickness=None,
    state_rates=thickness_kept,
)

# One temperature of a bath of oil.

POWER, BEGINS = "power = drag * contact.speed", '"bath_temperature": self.ambient'
MEAN = "np.mean(contact.pressure) * 1e-7 * contact.speed * self.conductance * self.thinning"

for words, old, new in (
    ("The bath's heat is that of an area", POWER, f"{POWER} / contact.grid.cell_area"),
    ("The bath's heat is the mean of the window", POWER, f"power = {MEAN}"),
    ("Heat that the bath loses warms it", "power - lost", "power + lost"),
    ("The bath begins at 20 °C, in the code", BEGINS, '"bath_temperature": 293.15'),
    ("The bath begins in degrees Celsius", BEGINS, f"{BEGINS} - 273.15"),
    (
        "A uniform temperature changes at each point",
        POWER,
        f"{POWER} * contact.pressure / np.max(contact.pressure)",
    ),
    ("Friction does not heat the bath", POWER, "power = 0.0"),
    (
        "The bath's heat is divided by the speed, also at rest",
        POWER,
        f"{POWER} * (contact.speed / contact.speed)",
    ),
    ("Oil thins by 30 K, in the code", "/ self.thinning", "/ 30.0"),
):
    mistake(words, Bath, old, new)

# A film that forms by sliding and fades in time.

FADED, FORMED = "film / self.life", "contact.speed * bare / self.length"

for words, *texts in (
    (
        "The film forms further where it is whole",
        *("(1 - film)", "1"),
        *(FADED, "0 * contact.pressure"),
    ),
    ("The film forms per second", FORMED, "bare / self.length"),
    ("The film fades over 50 s, in the code", FADED, "film / 50.0"),
    ("The film fades although there is none", FADED, "(1 / self.life + 0 * film)"),
    (
        "The film forms by the hardness of the first body",
        *(
            "film = ",
            "one, two = (m.hardness for m in contact.materials.values())\n        film = ",
        ),
        *(FORMED, f"{FORMED} * one / (one + two)"),
    ),
    ("The film never forms", FORMED, "0 * contact.pressure", FADED, "0.0"),
    (
        "Friction does not follow the film",
        'self.dry + (self.filmed - self.dry) * contact.state["film"]',
        "self.dry + 0 * contact.pressure",
    ),
    (
        "More film than half makes friction negative",
        "(self.filmed - self.dry)",
        "(self.filmed - 2 * self.dry)",
    ),
    (
        "The film forms by fresh random numbers",
        FORMED,
        f"{FORMED} * np.random.default_rng().uniform(0.9, 1.1, contact.pressure.shape)",
    ),
):
    mistake(words, Tribofilm, *texts)
