"""Numbers of a cycle, at each step of a run."""

from __future__ import annotations

import numpy as np
from tribo import LOCAL_SLIP, Array, Column, Field, Snapshot

TRACTION_X = Field("traction_x", "Pa", "Friction traction along x at the end of a stroke.")
TRACTION_Y = Field("traction_y", "Pa", "Friction traction along y at the end of a stroke.")
SLIP = Field("slip", "m", "Path that a point slips in a cycle.", at_least=0.0)


def _field(snapshot: Snapshot, field: Field) -> Array:
    return next(iter(snapshot.effects[field.name].values()))


def _integral(snapshot: Snapshot, traction: Array) -> float:
    """Return the integral of a traction over the contact: it is to the load as their sums are."""
    pressure = snapshot.state.contact.pressure
    return float(snapshot.measures.load * np.sum(traction) / np.sum(pressure))


def _force(snapshot: Snapshot) -> float:
    return _integral(snapshot, _field(snapshot, TRACTION_X))


def _energy(snapshot: Snapshot) -> float:
    traction = np.hypot(_field(snapshot, TRACTION_X), _field(snapshot, TRACTION_Y))
    return _integral(snapshot, traction * _field(snapshot, SLIP))


def _stick_part(snapshot: Snapshot, across: int | tuple[()] = ()) -> float:
    """Return the part of the contact that sticks: of its cells, or of its lines across an axis."""
    pressed = snapshot.state.contact.pressure > 0
    zones = pressed & (_field(snapshot, LOCAL_SLIP) == 0), pressed
    stuck, whole = (np.count_nonzero(zone.any(axis=across)) for zone in zones)
    return stuck / whole


def _stick_half_width_x(snapshot: Snapshot) -> float:
    return snapshot.measures.half_width_x * _stick_part(snapshot, 1)


def _stick_half_width_y(snapshot: Snapshot) -> float:
    return snapshot.measures.half_width_y * _stick_part(snapshot, 0)


def _volume_per_work(snapshot: Snapshot) -> float:
    volume = sum(body.wear_volume for body in snapshot.measures.bodies.values())
    return volume / (snapshot.measures.friction_energy or np.nan)


COLUMNS = (
    Column("tangential_force", "N", "tangential force at the end of a stroke", _force),
    Column("cycle_energy", "J", "energy of a cycle", _energy),
    Column("stick_part", "1", "stick part of the contact (0: gross slip)", _stick_part),
    Column("stick_half_width_x", "m", "half-width of the stick zone along x", _stick_half_width_x),
    Column("stick_half_width_y", "m", "half-width of the stick zone along y", _stick_half_width_y),
    Column("volume_per_work", "m^3/J", "worn volume per work of friction", _volume_per_work),
)
