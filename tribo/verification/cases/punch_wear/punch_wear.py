"""A flat punch: its first contact, and the rate at which its pressure becomes even."""

import numpy as np

import tribo
from tribo.core.state import State
from tribo.simulation.assembly import assemble
from tribo.stepping.first_contact import first_contact
from tribo.verification.cases.pins import disc, pin_on_flat

RADIUS, LOAD, K, MODULUS = 0.3e-3, 100.0, 3.11e-16, 113.736e9
# Short enough a step to tell the modes apart, and enough steps to be rid of the second.
STEP, STEPS = 0.5, 16


def found(cells: int) -> dict[str, float]:
    """Return the slowest rate, and the first contact over a disc's of the staircase's area."""
    grid = tribo.Grid(2.4 * RADIUS, cells)
    punch, radius = disc(grid, RADIUS)
    case = pin_on_flat(
        punch,
        tribo.Archard(k=K),
        grid=grid,
        load=LOAD,
        contact=tribo.DcFft(tolerance=1e-11),
        kinematics=tribo.Unidirectional(speed=0.1, track_length=2e-3, distance=1.0),
    )
    model = assemble(case)
    first = state = first_contact(model)
    length = STEP * radius / (K * MODULUS)
    for number in range(1, STEPS + 1):
        before = state
        state = model.case.stepping.step(model, state, length, number * length / 0.1)

    def beside_mean(state: State) -> tribo.Array:
        p = state.contact.pressure
        return p[p > 0] - np.mean(p[p > 0])

    # A mode falls to 1/(1 + rate * step) of itself; modes are orthogonal, so what is left of the
    # second enters as its square.
    last, earlier = beside_mean(state), beside_mean(before)
    middle = first.contact.pressure[cells // 2, cells // 2]
    return {
        "rate": (float(np.sum(earlier * last) / np.sum(last * last)) - 1) / STEP,
        "approach over F/2E*a": first.contact.approach * 2 * MODULUS * radius / LOAD,
        "pressure at the centre over F/2 pi a^2": middle * 2 * np.pi * radius**2 / LOAD,
    }
