"""The volumes that a lab would infer from the scars of a result."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tribo.lab.ball import (
    ball_cap_volume,
    conforming_ball_volume,
    flat_along_ball_volume,
)
from tribo.lab.scar import scar
from tribo.lab.track import circular_groove_area, groove_radius, planimetric_area
from tribo.result.body import BodyResult
from tribo.result.read import Result

_ROUND = 1e-9


@dataclass(frozen=True)
class InferredVolume:
    """A body's worn volume by a formula of a lab.

    Parameters
    ----------
    body : str
        The body.
    method : str
        What the formula takes the scar for.
    standard : str or None
        Where the formula is used, as ``"ASTM G99"``; None for one derived here.
    volume : float
        In m³.
    relative_error : float
        How far it is off the volume worn.
    """

    body: str
    method: str
    standard: str | None
    volume: float
    relative_error: float


def inferred_volumes(result: Result, save: int = -1) -> list[InferredVolume]:
    """Return the volumes by the usual formulas for a ball on a flat, at a save.

    Of a stationary ball: that of a flat cap of the scar's mean diameter, that
    of a scar conforming to the groove, whose section comes from one profile,
    and that of a scar flat along the sliding direction. Of a flat swept by it:
    that of a groove as deep as an unworn ball of the track's width would make
    it. The scars are measured by `scar`, and the lab knows the length of the
    track. Plastic indentation is left out.

    Parameters
    ----------
    result : Result
        What to measure.
    save : int, optional
        The save; the last one if left out.

    Returns
    -------
    list of InferredVolume
        Empty where the bodies are not a round ball and a flat, or nothing is worn.
    """
    pair = _ball_and_flat(result)
    if pair is None:
        return []
    ball, flat, radius = pair
    widths = {b.name: scar(b.wear_depth[save], result.grid) for b in (ball, flat)}
    section = track_section(result, flat, save)
    bodies = result.saves()[save]["bodies"]
    worn = {name: body["wear_volume_m3"] for name, body in bodies.items()}
    found: list[tuple[str, str, str | None, float]] = []
    seen = widths[ball.name]
    if not ball.swept and 0 < seen.mean_diameter < 2 * radius:
        volume = ball_cap_volume(seen.mean_diameter, radius)
        found.append((ball.name, "flat scar", "ASTM G99", volume))
        groove = groove_radius(seen.across, section) if section else np.inf
        if section and groove > radius:
            volume = conforming_ball_volume(seen.along, seen.across, radius, groove)
            found.append((ball.name, "scar in a groove", "ASTM D7755", volume))
        volume = flat_along_ball_volume(seen.along, seen.across, radius)
        found.append((ball.name, "scar flat along sliding only", None, volume))
    width = widths[flat.name].across
    if section and 0 < width < 2 * radius:
        length = worn[flat.name] / section
        volume = length * circular_groove_area(width, radius)
        found.append((flat.name, "groove of an unworn ball", "ASTM G99", volume))
    return [InferredVolume(*entry, entry[3] / worn[entry[0]] - 1.0) for entry in found]


def track_section(result: Result, body: BodyResult, save: int = -1) -> float | None:
    """Return the area of a track's section, in m²; None for a body that is not swept."""
    if not body.swept:
        return None
    return planimetric_area(body.wear_depth[save, 0], result.grid.spacing[1])


def _ball_and_flat(result: Result) -> tuple[BodyResult, BodyResult, float] | None:
    """Return a round body, the plane one and the radius, if they are that."""
    curvature = result.system.curvature
    bodies = [result.body(name) for name in result.body_names]
    flats = [body for body in bodies if np.ptp(body.height) == 0]
    if curvature is None or len(flats) != 1 or curvature[0] <= 0:
        return None
    if abs(curvature[1] / curvature[0] - 1) > _ROUND:
        return None
    (ball,) = (body for body in bodies if body is not flats[0])
    return ball, flats[0], 1 / curvature[0]
