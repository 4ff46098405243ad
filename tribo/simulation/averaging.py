"""What a motion says of its averaging, asked with the contact and the track of a state."""

from __future__ import annotations

import numpy as np

from tribo.core.errors import located
from tribo.core.measures import half_widths
from tribo.core.state import State
from tribo.simulation.model import Model


def check_stroke(model: Model, state: State) -> None:
    """Raise `CaseError` if averaging makes no sense for the first contact, in `state`."""
    if _changing(model):
        with located("kinematics"):
            model.motion.check_contact(half_widths(state.contact, model.grid)[0])


def limitation(model: Model, state: State) -> str | None:
    """Return why the track average does not hold in `state`, if so."""
    changing = _changing(model)
    half_width = half_widths(state.contact, model.grid)[0]
    words = model.motion.limitation(
        model.grid,
        half_width,
        max((float(np.max(state.bodies[name].wear)) for name in changing), default=0.0),
        state.reference_depth,
        _volume_ratio(model, state),
    )
    # A contact all over the period that repeats has no ends.
    endless = model.contact.periodic and 2 * half_width > model.grid.size[0] * (1 - 1e-9)
    return words if changing and not endless else None


def _volume_ratio(model: Model, state: State) -> float:
    """Return the volume worn off the bodies that stay over that off those that are swept."""
    lost = {True: 0.0, False: 0.0}
    for name, body in state.bodies.items():
        lost[name in model.swept] += model.exposures[name].volume(body.wear)
    if lost[True] == 0:
        return 1.0 if lost[False] == 0 else np.inf
    return lost[False] / lost[True]


def _changing(model: Model) -> list[str]:
    """Return the names of the swept bodies that change their shape."""
    return [
        name
        for name in model.bodies
        if name in model.swept and (name in model.laws or model.plastic_share[name] > 0)
    ]
