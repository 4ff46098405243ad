"""Flat punches that wear to an even pressure: the rate at which the rest decays."""

import numpy as np

import tribo
from tribo.core.state import State
from tribo.simulation.assembly import assemble
from tribo.stepping.first_contact import first_contact

RADIUS, K, MODULUS = 0.3e-3, 3.11e-16, 113.736e9
# Short enough a step to tell the modes apart, and enough steps to be rid of the second.
STEP, STEPS = 0.5, 16
STEEL = tribo.Material(young="207 GPa", poisson=0.3)


def rate(
    inside: tribo.Mask,
    grid: tribo.Grid,
    radius: float,
    contact: tribo.ContactSolver,
    load: float,
    tilt: tribo.Array,
) -> float:
    """Return the slowest rate, from what is left of the pressure beside its mean."""
    punch = tribo.HeightMap(size=grid.size, heights=np.where(inside, tilt, -1e-3))
    motion = tribo.Unidirectional(speed=0.1, track_length=2e-3, distance=1.0)
    bodies = {
        "punch": tribo.Body(surface=punch, material=STEEL, wear=tribo.Archard(k=K)),
        "flat": tribo.Body(surface=tribo.Flat(), material=STEEL),
    }
    model = assemble(
        tribo.Case(grid=grid, load=load, bodies=bodies, contact=contact, kinematics=motion)
    )

    def beside_mean(state: State) -> tribo.Array:
        p = state.contact.pressure
        field = np.where(inside, p - np.mean(p[inside]), 0.0)
        return 0.5 * (field - field[::-1]) if tilt.any() else field

    state = first_contact(model)
    length = STEP * radius / (K * MODULUS)
    for number in range(1, STEPS + 1):
        before = state
        state = model.case.stepping.step(model, state, length, number * length / 0.1)
    # A mode falls to 1/(1 + rate * step) of itself; modes are orthogonal, so what is left of the
    # second enters as its square.
    first, last = beside_mean(before), beside_mean(state)
    return (float(np.sum(first * last) / np.sum(last * last)) - 1) / STEP


def found(part: float, cells: int, strip: int) -> dict[str, float]:
    """Return the rates of a disc, and of a strip 400 half-widths from the next one."""
    grid = tribo.Grid(2.4 * RADIUS, cells)
    disc = np.hypot(*grid.mesh) < RADIUS
    radius = np.sqrt(np.count_nonzero(disc) * grid.cell_area / np.pi)
    free = tribo.DcFft(tolerance=1e-11)
    rates = {"disc": rate(disc, grid, radius, free, 100.0, np.zeros(grid.cells))}
    grid = tribo.Grid((400 * RADIUS, 8 * RADIUS / strip), (200 * strip, 4))
    x = np.broadcast_to(grid.mesh[0], grid.cells)
    repeated, load = tribo.Periodic(tolerance=1e-11), 1e6 * grid.size[1]
    for name, tilt in (("even", 0 * x), ("odd", 1e-8 * x / RADIUS)):
        rates[f"strip, {name}"] = rate(np.abs(x) < RADIUS, grid, RADIUS, repeated, load, tilt)
    return rates
