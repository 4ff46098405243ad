"""Flat punches that wear to uniform pressure: the rate of the slowest mode."""

from __future__ import annotations

import numpy as np

from tribo.closed_forms.punch_wear import disc_rates, strip_rates
from tribo.contact.dcfft import DcFft
from tribo.contact.periodic import Periodic
from tribo.core.arrays import Array, Mask
from tribo.core.grid import Grid
from tribo.core.state import State
from tribo.verification import paper_bodies as paper
from tribo.verification.reference import Row, reference

RADIUS = 0.3e-3
# Short enough a step to tell the modes apart, and enough steps to be rid of the second.
STEP, STEPS = 0.5, 16
SOURCE = "Galin (1976); tribo.closed_forms.punch_wear"


def _rate(
    inside: Mask, grid: Grid, radius: float, contact: DcFft | Periodic, load: float, tilt: Array
) -> float:
    shape = paper.Shape(heights=lambda _: np.where(inside, tilt, -1e-3))
    model = paper.on_flat(shape, grid, contact, load=load)
    unit = radius / (paper.WEAR_COEFFICIENT * paper.MODULUS)
    states = paper.slide(model, STEPS * STEP * unit, STEPS)
    before, after = (_beside_mean(state, inside) for state in states)
    if tilt.any():
        before, after = (0.5 * (field - field[::-1]) for field in (before, after))
    # A mode falls to 1/(1 + λ step) of itself; modes are orthogonal, so what is left of the
    # second enters as its square.
    factor = float(np.sum(after * after) / np.sum(before * after))
    return (1 / factor - 1) / STEP


def _beside_mean(state: State, inside: Mask) -> Array:
    pressure = state.contact.pressure
    return np.where(inside, pressure - np.mean(pressure[inside]), 0.0)


def _row(prefix: str, exact: float, got: float) -> Row:
    # 2 - 1/ln(a/h), with 12 to 100 cells a radius.
    order, note = 1.75, "h^2 ln(1/h), for the mode's slope is infinite at the edge"
    return Row(f"{prefix}slowest rate, in kE*/a", "1", exact, got, 1e-3, order, note)


@reference("flat round punch wears", SOURCE, 61, 121, 241)
def _disc(cells: int, placement: float) -> list[Row]:
    grid = paper.square(2.4 * RADIUS, cells, placement)
    inside, level = np.hypot(*grid.mesh) < RADIUS, np.zeros(grid.cells)
    radius, contact = paper.drawn_radius(inside, grid), DcFft(tolerance=1e-11)
    return [_row("", disc_rates()[0], _rate(inside, grid, radius, contact, 100.0, level))]


@reference("flat strip wears (periodic, 400 half-widths apart)", SOURCE, 24, 48, 96)
def _strip(cells: int, placement: float) -> list[Row]:
    # Images 400 half-widths away change the rate by less than a hundred-thousandth.
    size = (400 * RADIUS, 4 * RADIUS / cells)
    grid = Grid(size, (200 * cells, 2))
    x, y = grid.mesh
    inside = (np.abs(x) < RADIUS) & (np.abs(y) < size[1])
    tilt = 1e-8 * np.broadcast_to(x / RADIUS, grid.cells)
    even, odd = (
        _rate(inside, grid, RADIUS, Periodic(tolerance=1e-11), 1e6 * size[1], tilted)
        for tilted in (0 * tilt, tilt)
    )
    return [
        _row("even, ", strip_rates()[0], even),
        _row("odd, ", strip_rates(odd=True)[0], odd),
    ]
