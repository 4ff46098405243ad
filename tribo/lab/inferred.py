"""The volumes that a lab would infer from the scars of a result."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from tribo.core.arrays import middle_rows
from tribo.core.rounding import ROUND_OFF
from tribo.core.words import signed
from tribo.lab.formulas import (
    ball_cap_volume,
    circular_groove_area,
    conforming_ball_volume,
    groove_radius,
    planimetric_area,
)
from tribo.lab.scar import Scar, scar
from tribo.result.body import BodyResult
from tribo.result.read import Result

UNWORN = "groove of an unworn ball"


class InferredVolume(NamedTuple):
    """A body's worn volume by a formula of a lab.

    Parameters
    ----------
    body : str
        The body.
    method : str
        The shape of the scar that the formula assumes.
    standard : str
        Where the formula is used, as ``"ASTM G99"``.
    volume_m3 : float
        In m³.
    relative_error : float
        Its relative difference from the volume worn.

    Examples
    --------
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=4 um"]
    >>> result = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse).run()
    >>> flat = result.report().inferred[0]
    >>> flat.standard, flat.method, f"{flat.off} %"  # of the worn volume
    ('ASTM G99', 'flat scar', '+20 %')
    """

    body: str
    method: str
    standard: str
    volume_m3: float
    relative_error: float

    @property
    def off(self) -> str:
        """Its relative error, in %."""
        return signed(100 * self.relative_error, 0)


def inferred(body: str, method: str, standard: str, volume: float, worn: float) -> InferredVolume:
    """Return a volume by a formula with its error relative to the volume worn."""
    return InferredVolume(body, method, standard, volume, volume / worn - 1)


def inferred_volumes(result: Result, save: int = -1) -> list[InferredVolume]:
    """Return the volumes by the usual formulas for a ball on a flat, at a save.

    For a stationary ball: the volume of a flat cap of the scar's mean diameter,
    and of a scar conforming to the groove, whose section comes from one profile.
    For a flat swept by it: the volume of the groove that an unworn ball makes at
    the track's width. The scars are measured by `scar`, and the lab knows the
    length of the track. Plastic indentation is left out.

    G99 asks for the first and the last only where the other body hardly wears, and all assume a
    scar that is deep beside the elastic flattening: elsewhere they are inaccurate.

    Returns
    -------
    list of InferredVolume
        Empty where the bodies are not a round ball and a flat, or nothing is worn.
    """
    pair = _ball_and_flat(result)
    if pair is None:
        return []
    ball, flat, radius = pair
    worn = {name: body["wear_volume_m3"] for name, body in result.saves()[save]["bodies"].items()}
    seen = scar(ball.wear_depth[save], result.grid)
    width = scar(flat.wear_depth[save], result.grid).across
    section = track_section(result, flat, save)
    found: list[InferredVolume] = []
    if not ball.swept and 0 < seen.mean_diameter < 2 * radius:
        groove = groove_radius(seen.across, section) if section else None
        found += ball_volumes(ball.name, seen, radius, groove, worn[ball.name])
    if section and 0 < width < 2 * radius:
        volume = worn[flat.name] / section * circular_groove_area(width, radius)
        found.append(inferred(flat.name, UNWORN, "ASTM G99", volume, worn[flat.name]))
    return found


def ball_volumes(
    body: str, seen: Scar, radius: float, groove: float | None, worn: float
) -> list[InferredVolume]:
    """Return a ball's volumes by formulas, from its scar, its radius and the groove's in m."""
    cap = ball_cap_volume(seen.mean_diameter, radius)
    found = [inferred(body, "flat scar", "ASTM G99", cap, worn)]
    if groove and groove > radius:
        volume = conforming_ball_volume(*seen, radius, groove)
        found.append(inferred(body, "scar in a groove", "ASTM D7755", volume, worn))
    return found


def track_section(result: Result, body: BodyResult, save: int = -1) -> float | None:
    """Return the area of a track's section, in m²; None for a body without a straight track."""
    if not (body.swept and body.straight):
        return None
    middle = middle_rows(body.wear_depth[save], 1)[0]
    return planimetric_area(middle, result.grid.spacing[1])


def _ball_and_flat(result: Result) -> tuple[BodyResult, BodyResult, float] | None:
    curvature = result.system.curvature
    bodies = sorted(map(result.body, result.body_names), key=lambda body: np.ptp(body.height))
    flat, ball = bodies
    if np.ptp(flat.height) > 0 or np.ptp(ball.height) == 0 or curvature is None:
        return None
    if curvature[0] <= 0 or abs(curvature[1] / curvature[0] - 1) > ROUND_OFF:
        return None
    return ball, flat, 1 / curvature[0]
