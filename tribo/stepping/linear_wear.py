"""The wear of a step, linear in the pressures of a cycle: a compliance of the contact."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import reduce
from typing import TYPE_CHECKING

import numpy as np

from tribo.core.arrays import Array, union
from tribo.core.contact import ContactSolution, CycleCompliance, WearCompliance
from tribo.core.fields import WearRate
from tribo.evolution.rates import CycleRates

if TYPE_CHECKING:
    from tribo.model.model import Model


def linear_wear(
    model: Model, rates: CycleRates, contacts: Sequence[ContactSolution], increment: float
) -> Sequence[WearCompliance] | CycleCompliance:
    """Return the wear over `increment` (m), linearised about the pressures of `contacts`.

    It is one compliance for each position, or one for all where these are solved together.
    """
    if model.couples:
        return _coupling(model, rates, contacts, increment)
    return [
        wear_compliance(model, of_bodies, contact.pressure, increment)
        for of_bodies, contact in zip(rates, contacts, strict=True)
    ]


def add_depths(
    gaps: Array,
    part: float,
    wear: Sequence[WearCompliance] | CycleCompliance,
    contacts: Sequence[ContactSolution],
    dx: float,
) -> Array:
    """Add a part of the depth worn at each position to `gaps`, (positions, nx, ny), in m."""
    if isinstance(wear, CycleCompliance):
        # Elsewhere nothing wears.
        columns = reduce(union, (contact.extent for contact in contacts))[1]
        pressure = np.stack([contact.pressure[:, columns] for contact in contacts])
        gaps[..., columns] += part * wear.beside(columns).depth(pressure, dx)
        return gaps
    for gap, compliance, contact in zip(gaps, wear, contacts, strict=True):
        gap += part * compliance.depth(contact.pressure, dx)
    return gaps


def wear_compliance(
    model: Model, rates: Mapping[str, WearRate], pressure: Array, increment: float
) -> WearCompliance:
    """Return the wear over `increment` (m) at a position, linear in pressure, as a compliance."""
    local = np.zeros(model.grid.cells)
    swept = np.zeros(model.grid.cells[1])
    for name, rate in rates.items():
        part = model.cycle.maps[name].compliance(rate.depth_slope, pressure)
        if part is not None:
            local += increment * part.local
            swept += increment * part.swept
    return WearCompliance(local, swept)


def _coupling(
    model: Model, rates: CycleRates, contacts: Sequence[ContactSolution], increment: float
) -> CycleCompliance:
    """Return the wear at all positions, each point of a body with the mean slope of its law."""
    shares = np.array([position.share for position in model.cycle])
    bodies = []
    for name in rates[0]:
        exposure = model.cycle.maps[name]
        shape = (exposure.rows, model.grid.cells[1])
        weighed, load, nearby = np.zeros(shape), np.zeros(shape), np.zeros(shape[1])
        for position, (share, contact) in enumerate(zip(shares, contacts, strict=True)):
            pressure, slope = contact.pressure, rates[position][name].depth_slope
            weighed = exposure.gather(slope * pressure, position, share, weighed)
            load = exposure.gather(pressure, position, share, load)
            np.maximum(nearby, np.max(exposure.average(slope), axis=0), out=nearby)
        # A point that is yet to be touched has the slope that its law gives near it, on its row.
        slope = np.where(load > 0, weighed / np.where(load > 0, load, 1.0), nearby)
        bodies.append((increment * slope, [*map(exposure.first_cell, range(len(shares)))]))
    return CycleCompliance(shares, bodies, slice(0, model.grid.cells[0]))
