"""Effects that follow the cells rather than the place, or who moves; they name bodies too.

They were written without sight of the checks.
"""

import numpy as np
from testing.conformance.mistaken import mistake
from testing.conformance.models import Bath, Debris, Heating, Tribofilm
from testing.conformance.models_of_contact import Flash, Slip, Spreading, Transfer

# Cells.

mistake(
    "Debris leaves by the cell that it crosses along x",
    Spreading,
    leaving=lambda self, c: c.speed * self.leaves * c.state["spread"] / c.grid.spacing[0],
)
mistake(
    "Debris leaves by the cell across the sliding",
    Spreading,
    leaving=lambda self, c: c.speed * self.leaves * c.state["spread"] / c.grid.spacing[1],
)
mistake(
    "Debris leaves at the end of a window",
    Spreading,
    leaving=lambda self, c: c.speed * self.leaves * c.state["spread"] / c.grid.size[0],
)


def in_squares(self, contact):
    t, dx = np.pad(contact.state["spread"], 1, mode="edge"), contact.grid.spacing[0]
    middle = t[1:-1, 1:-1]
    return (t[2:, 1:-1] + t[:-2, 1:-1] + t[1:-1, 2:] + t[1:-1, :-2] - 4 * middle) / dx**2


mistake("Debris spreads as if cells were squares", Spreading, curved=in_squares)


def over_the_window(self, contact):
    (nx, ny), (lx, ly) = contact.grid.cells, contact.grid.size
    return Spreading.curved(self, contact) * (lx / nx) * (ly / ny) / (lx * ly)


mistake("Debris spreads per area of the window, not of a cell", Spreading, curved=over_the_window)
mistake(
    "Debris spreads round the window's edge",
    Spreading,
    curved=lambda self, c: (
        (
            np.roll(c.state["spread"], 1, 0)
            - 2 * c.state["spread"]
            + np.roll(c.state["spread"], -1, 0)
        )
        / c.grid.spacing[0] ** 2
    ),
)
mistake(
    "The load is a sum over square cells",
    Flash,
    load=lambda self, c: np.sum(c.pressure) * c.grid.spacing[0] ** 2,
)
mistake(
    "The radius is that of a row of cells",
    Flash,
    radius=lambda self, c: np.count_nonzero(c.pressure) * c.grid.spacing[0] / np.pi,
)
mistake(
    "The radius is that of the window",
    Flash,
    radius=lambda self, c: 0.5 * min(c.grid.size),
)
mistake(
    "The load is the mean pressure times the window",
    Flash,
    load=lambda self, c: np.mean(c.pressure) * c.grid.size[0] ** 2,
)
mistake(
    "The heat is taken by the steepest difference of neighbours",
    Heating,
    flux=lambda self, c, mu: mu * c.speed * (c.pressure + np.abs(np.gradient(c.pressure, axis=0))),
)
mistake(
    "The bath's heat is per length of a cell",
    Bath,
    power=lambda self, c: Bath.power(self, c) * c.grid.spacing[0] / c.grid.size[0],
)
mistake(
    "Debris covers by cells of its length",
    Debris,
    share=lambda self, c: (
        -np.expm1(-c.state["debris"] / self.cover * self.length / c.grid.spacing[0] * 1e-4)
    ),
)
mistake(
    "A film forms over as many cells as the window has",
    Tribofilm,
    formed=lambda self, c: Tribofilm.formed(self, c) * 24 / c.grid.cells[0],
)

# Who moves.

mistake(
    "The last body is taken to move",
    Flash,
    cooled=lambda self, name, c: (
        Flash.cooled(self, next(iter(c.swept), ""), c) if name == list(c.materials)[-1] else 1.0
    ),
)
mistake(
    "The body called disk is taken to move",
    Flash,
    cooled=lambda self, name, c: 0.5 if name == "disk" else 1.0,
)
mistake(
    "There is taken to be one body that moves",
    Flash,
    cooled=lambda self, name, c: (
        Flash.cooled(self, next(iter({*c.swept} - {name}), name), c)
        * (1 + (name == next(iter(c.swept))))
    ),
)
mistake(
    "Only the wear of the last body becomes debris",
    Debris,
    source=lambda self, c: 2 * self.caught * list(c.wear_rates.values())[-1],
)
mistake(
    "What moves is found by its place in the case",
    Debris,
    source=lambda self, c: self.caught * c.wear_rates[sorted(c.wear_rates)[0]],
)

# Bodies that an effect names.


def transfer(words, **parts):
    mistake(words, Transfer, **parts)


transfer(
    "The film lies on the body called disk, whatever its key says", carrier=lambda self: "disk"
)
transfer(
    "The film grows per second",
    state_rates=lambda self, c: {"transferred": self.source(c) - self.leaving(c)},
)
transfer(
    "The film of 1 µm covers, in the code",
    share=lambda self, c: -np.expm1(-c.state["transferred"] / 1e-6),
)
transfer("The length is not used", leaving=lambda self, c: c.state["transferred"] / self.cover)
transfer(
    "The wear of the body called ball is transferred",
    source=lambda self, c: c.wear_rates["ball"],
)
transfer(
    "The film carries by its mean",
    share=lambda self, c: -np.expm1(-np.mean(c.state["transferred"]) / self.cover) + 0 * c.pressure,
)
transfer(
    "The film leaves by the cell",
    leaving=lambda self, c: np.where(c.pressure > 0, c.state["transferred"] / c.grid.spacing[0], 0),
)
transfer(
    "The film carries beyond all the load",
    share=lambda self, c: c.state["transferred"] / self.cover,
)
transfer(
    "The film is carried on only by its body",
    fields=lambda self, c: {"load_share": {self.on: self.share(c)}},
)

# Slip, and what rests.

mistake(
    "Slip is more than the whole way",
    Slip,
    slip=lambda self, c: 1.2 / (1 + c.pressure * 0.3 / self.strength),
)
mistake(
    "A body that stays does not slip",
    Slip,
    fields=lambda self, c: {
        "local_slip": {n: self.slip(c) if n in c.swept else 0 * c.pressure for n in c.materials}
    },
)
mistake(
    "Slip is counted from the middle of the window",
    Slip,
    slip=lambda self, c: (
        Slip.slip(self, c) * np.minimum(1.0, np.hypot(*c.grid.mesh) / (0.2 * c.grid.size[0]))
    ),
)
mistake(
    "Slip is by the largest pressure of the window, at each point",
    Slip,
    slip=lambda self, c: 1 - 0.5 * c.pressure / c.pressure.max(),
)
mistake(
    "What leaves at a reversal is divided by the track, which may have no end",
    Spreading,
    leaving=lambda self, c: (
        c.speed * self.leaves * c.state["spread"] * (c.track / (c.track * c.track))
    ),
)
mistake(
    "The logarithm of the speed is taken, also at rest",
    Flash,
    cooled=lambda self, name, c: 1 / (1 + np.log(c.speed / self.diffusivity * self.radius(c)) ** 2),
)
