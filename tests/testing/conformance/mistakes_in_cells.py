"""Effects that follow the cells rather than the place, or who moves; they name bodies too.

They were written without sight of the checks.
"""

from testing.conformance.honest_effects import (
    Bath,
    Debris,
    Flash,
    Heating,
    Slip,
    Spreading,
    Transfer,
    Tribofilm,
)
from testing.conformance.mistaken import mistake

# Cells.

SPACING, SIZE = "contact.grid.spacing", "contact.grid.size"
CURVED, ALONG = "(along / dx**2 + across / dy**2)", "t[2:, 1:-1] - 2 * t[1:-1, 1:-1] + t[:-2, 1:-1]"
ROUND = "np.roll(height, 1, 0) - 2 * height + np.roll(height, -1, 0)"

for words, *texts in (
    ("Debris leaves by the cell that it crosses along x", "contact.track", f"{SPACING}[0]"),
    ("Debris leaves by the cell across the sliding", "contact.track", f"{SPACING}[1]"),
    ("Debris leaves at the end of a window", "contact.track", f"{SIZE}[0]"),
    ("Debris spreads as if cells were squares", CURVED, "(along + across) / dx**2"),
    (
        "Debris spreads per area of the window, not of a cell",
        CURVED,
        f"{CURVED} / np.prod(contact.grid.cells)",
    ),
    ("Debris spreads round the window's edge", ALONG, ROUND, " + across / dy**2", ""),
    (
        "What leaves at a reversal is divided by the track, which may have no end",
        "/ contact.track",
        "* (contact.track / (contact.track * contact.track))",
    ),
):
    mistake(words, Spreading, *texts)

LOAD, COOLED = "load = np.sum(contact.pressure) * contact.grid.cell_area", "name in contact.swept"
RADIUS = "np.sqrt(cells * contact.grid.cell_area / np.pi)"
LAST = "name == [*contact.materials][-1] and contact.swept"
FIRST = "name == next(iter(contact.swept))"

for words, *texts in (
    (
        "The load is a sum over square cells",
        LOAD,
        f"load = np.sum(contact.pressure) * {SPACING}[0] ** 2",
    ),
    ("The radius is that of a row of cells", RADIUS, f"cells * {SPACING}[0] / np.pi"),
    ("The radius is that of the window", RADIUS, f"0.5 * min({SIZE})"),
    (
        "The load is the mean pressure times the window",
        LOAD,
        f"load = np.mean(contact.pressure) * {SIZE}[0] ** 2",
    ),
    ("The last body is taken to move", COOLED, LAST),
    (
        "The body called disk is taken to move",
        f"1 / (1 + peclet) if {COOLED}",
        '0.5 if name == "disk"',
    ),
    (
        "There is taken to be one body that moves",
        *(COOLED, "contact.swept"),
        *("* cooled", f"* cooled * (1 + ({FIRST}))"),
    ),
    (
        "The logarithm of the speed is taken, also at rest",
        f"1 / (1 + peclet) if {COOLED} else 1.0",
        "1 / (1 + np.log(peclet) ** 2)",
    ),
):
    mistake(words, Flash, *texts)

HEAT = "friction * contact.pressure * contact.speed"
STEEP = "np.abs(np.gradient(contact.pressure, axis=0))"
SUM = "sum(contact.wear_rates.values())"

for words, honest, old, new in (
    (
        "The heat is taken by the steepest difference of neighbours",
        Heating,
        HEAT,
        f"friction * contact.speed * (contact.pressure + {STEEP})",
    ),
    (
        "The bath's heat is per length of a cell",
        Bath,
        "drag * contact.speed",
        f"drag * contact.speed * {SPACING}[0] / {SIZE}[0]",
    ),
    (
        "Debris covers by cells of its length",
        Debris,
        'contact.state["debris"] / self.cover',
        f'contact.state["debris"] / self.cover * 1e-4 * self.length / {SPACING}[0]',
    ),
    (
        "A film forms over as many cells as the window has",
        Tribofilm,
        "contact.speed * bare / self.length",
        "contact.speed * bare / self.length * 24 / contact.grid.cells[0]",
    ),
    (
        "Only the wear of the last body becomes debris",
        Debris,
        SUM,
        "2 * [*contact.wear_rates.values()][-1]",
    ),
    (
        "What moves is found by its place in the case",
        Debris,
        SUM,
        "contact.wear_rates[min(contact.wear_rates)]",
    ),
):
    mistake(words, honest, old, new)

# Bodies that an effect names.

STATE = 'contact.state["debris"] / self.cover'
SHARE, LEAVES = f"-np.expm1(-{STATE})", "thickness / self.length"
RATE = "contact.speed * (self.source(contact) - leaving)"

for words, old, new in (
    (
        "The film lies on the body called disk, whatever its key says",
        "return self.on",
        'return "disk"',
    ),
    ("The film grows per second", RATE, "self.source(contact) - leaving"),
    ("The film of 1 µm covers, in the code", "/ self.cover", "/ 1e-6"),
    ("The length is not used", LEAVES, "thickness / self.cover"),
    (
        "The wear of the body called ball is transferred",
        "self.caught * lost",
        'self.caught * contact.wear_rates["ball"]',
    ),
    (
        "The film carries by its mean",
        SHARE,
        '-np.expm1(-np.mean(contact.state["debris"]) / self.cover) + 0 * contact.pressure',
    ),
    ("The film leaves by the cell", LEAVES, f"thickness / {SPACING}[0]"),
    ("The film carries beyond all the load", SHARE, STATE),
    (
        "The film is carried on only by its body",
        "dict.fromkeys(contact.materials, share)",
        "{self.on: share}",
    ),
):
    mistake(words, Transfer, old, new)

# Slip.

SLIP, TOP = "1 / (1 + friction * contact.pressure / self.strength)", "contact.pressure.max()"
MIDDLE = f"np.minimum(1.0, np.hypot(*contact.grid.mesh) / (0.2 * {SIZE}[0]))"

for words, old, new in (
    ("Slip is more than the whole way", SLIP, "1.2 / (1 + contact.pressure * 0.3 / self.strength)"),
    (
        "A body that stays does not slip",
        "dict.fromkeys(contact.materials, self.slip(contact))",
        "{n: self.slip(contact) * (n in contact.swept) for n in contact.materials}",
    ),
    ("Slip is counted from the middle of the window", SLIP, f"{SLIP} * {MIDDLE}"),
    (
        "Slip is by the largest pressure of the window, at each point",
        SLIP,
        f"1 - 0.5 * contact.pressure / {TOP}",
    ),
):
    mistake(words, Slip, old, new)
