"""An effect of one's own: debris that wear feeds, sliding removes, and that carries load.

Takes some seconds::

    python examples/own_effect.py
"""

from collections.abc import Mapping
from typing import Annotated

import numpy as np

from tribo import LOAD_SHARE, Array, Case, ContactConditions, Effect, Field, Quantity

THICKNESS = Field("debris_thickness", "m", "Height of debris.", at_least=0, typical=1e-9)


class Debris(Effect):
    """dt/ds = r₁ + r₂ - t/length; it carries the part 1 - exp(-t/cover) of the pressure."""

    type = "own.debris"
    reach = "point"
    examples = ({"length": "20 mm", "cover": "1 nm"},)
    length: Annotated[float, Quantity("m", above=0)]
    """Sliding distance over which 1/e of it stays."""
    cover: Annotated[float, Quantity("m", above=0)]
    """Thickness that leaves 1/e of the pressure to the bodies."""

    state_fields = (THICKNESS,)
    provides = (LOAD_SHARE,)

    def fields(self, contact: ContactConditions) -> Mapping[str, Mapping[str, Array]]:
        """Return the part of the pressure that it carries, for each body."""
        share = 1 - np.exp(-contact.state["debris_thickness"] / self.cover)
        return {"load_share": dict.fromkeys(contact.materials, share)}

    def state_rates(self, contact: ContactConditions) -> Mapping[str, Array]:
        """Return how fast the height changes, in m/s."""
        thickness, worn = contact.state["debris_thickness"], sum(contact.wear_rates.values())
        leaves = np.where(contact.pressure > 0, thickness / self.length, 0)
        return {"debris_thickness": contact.speed * (worn - leaves)}


if __name__ == "__main__":
    steel = {"young": "207 GPa", "poisson": 0.3}
    archard = {"type": "archard", "k": 3.11e-16}
    case = Case(
        grid={"size": "0.7 mm", "cells": 22},
        load="100 N",
        bodies={
            "ball": {
                "surface": {"type": "sphere", "radius": "5 mm"},
                "material": steel,
                "wear": archard,
            },
            "disk": {"surface": "flat", "material": steel, "wear": archard},
        },
        kinematics={
            "type": "reciprocating",
            "stroke": "2 mm",
            "frequency": 25,
            "duration": 3,
            "positions": "average",
        },
        effects=[Debris(length="20 mm", cover="1 nm")],
    )
    with case.run() as result:
        result.show()
        print(f"debris: at most {1e9 * result.field('debris_thickness', -1).max():.2f} nm")
