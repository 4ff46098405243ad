"""Steel pins on a steel flat, for the scripts of cases."""

from __future__ import annotations

from typing import Any

import tribo

STEEL = tribo.Material(young="207 GPa", poisson=0.3)


def pin_on_flat(
    surface: tribo.Surface, wear: tribo.WearLaw | None = None, **case: Any
) -> tribo.Case:
    """Return a case of a pin with this surface, which alone wears, if any does."""
    pin = tribo.Body(surface=surface, material=STEEL, wear=wear)
    flat = tribo.Body(surface=tribo.Flat(), material=STEEL)
    return tribo.Case(bodies={"pin": pin, "flat": flat}, **case)
