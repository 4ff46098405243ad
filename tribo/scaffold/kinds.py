"""What the files of a new plugin say of its kind."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Start:
    """The beginning of a plugin of one kind.

    Parameters
    ----------
    place : str
        Where a case names it, in the result's provenance.
    configs : tuple of str
        The quantities of the configurations that its conformance test tries.
    """

    place: str
    configs: tuple[str, ...]


STARTS = {
    "wear_law": Start("bodies.ball.wear", ("k=1e-15", "k=0.0")),
    "contact_solver": Start("contact", ("coating=0.0", "coating=1e-16")),
    "kinematics": Start("kinematics", ("speed=0.1, track=0.02, duration=60.0",)),
    "surface": Start("bodies.ball.surface", ("radius=5e-3",)),
    "effect": Start("effects[0]", ("friction=0.2",)),
    "observer": Start("observers[0]", ("depth=1e-7",)),
}
"""By kind, as in `tribo.registry.kinds.KINDS`."""
