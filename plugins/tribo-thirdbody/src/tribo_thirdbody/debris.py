"""Debris between the bodies: fed by wear, left behind by sliding, and bearing load."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Annotated, Literal

import numpy as np
from tribo import LOAD_SHARE, Array, ContactConditions, Effect, Field, Quantity

THICKNESS = Field("debris_thickness", "m", "Height of debris, without pores.", at_least=0)


class Debris(Effect):
    """dt/ds = c (r₁ + r₂) − t/λ: what both bodies lose per metre, less what leaves the contact.

    Debris carries the part 1 − exp(−t/t₀) of the pressure and does not wear what it lies on. Under
    an even pressure p that wears both by K p s, it tends to t₀ W(c λ K p/t₀), with Lambert's W.
    Valid where it stays for many diameters of its particles, leaves in proportion to its amount,
    and is too soft to abrade.

    Sources: Godet (1984), Wear 100, 437-452; Fillot et al. (2007), Wear 262, 949-957.

    Examples
    --------
    >>> from tribo_thirdbody.debris import Debris
    >>> steel = dict.fromkeys(("ball", "disk"), tribo.materials["100Cr6"])
    >>> system = tribo.ContactSystem(tribo.Grid("1 mm", 4), 115e9, load=10.0, materials=steel)
    >>> layer = {"debris_thickness": np.full((4, 4), 1e-6)}
    >>> pressure = np.full((4, 4), 10e6)
    >>> contact = tribo.ContactConditions(system, pressure, 0.1, 0.0, 0.0, frozenset(), state=layer)
    >>> share = Debris(ejection_length="0.5 m", cover="1 um").fields(contact)["load_share"]["ball"]
    >>> round(float(share.max()), 2)  # of the load is on 1 µm of debris
    0.63
    """

    examples = ({"ejection_length": "0.5 m", "cover": "1 um"},)
    type = "thirdbody.debris"
    ejection_length: Annotated[float, Quantity("m", above=0)]
    """Sliding distance λ over which 1/e of the debris stays."""
    cover: Annotated[float, Quantity("m", above=0, usual=(1e-10, 1e-3))]
    """Thickness t₀ that leaves 1/e of the pressure to the bodies."""
    caught: Annotated[float, Quantity("1", at_least=0, at_most=1)] = 1.0
    """Part c of what is worn that becomes debris; the rest leaves at once."""
    on: str | None = None
    """The body on which it lies; in the contact, between both, if left out."""
    fills: bool = False
    """Whether the bodies meet on it, at its height without pores, or as if it gave way. Then it
    leaves in proportion to the pressure, relative to the mean over the load Σp²/Σp. Where a
    body that passes wears too, let it lie `on` that: elsewhere it may fill a gap faster than that
    opens, and the load draws together on few points.
    """

    provides = (LOAD_SHARE,)

    @property
    def reach(self) -> Literal["point", "contact"]:  # type: ignore[override]
        """The point; and the mean pressure, where it fills the gap."""
        return "contact" if self.fills else "point"

    @property
    def state_fields(self) -> tuple[Field, ...]:  # type: ignore[override]
        """The height of the debris."""
        return (replace(THICKNESS, fills=self.fills),)

    def carrier(self) -> str | None:
        """Return the body on which it lies."""
        return self.on

    def fields(self, contact: ContactConditions) -> Mapping[str, Mapping[str, Array]]:
        """Return the load share of the debris."""
        share = -np.expm1(-contact.state[THICKNESS.name] / self.cover)
        return {LOAD_SHARE.name: dict.fromkeys(contact.materials, share)}

    def state_rates(self, contact: ContactConditions) -> Mapping[str, Array]:
        """Return the rate of debris per second: added by wear, removed by sliding."""
        caught = self.caught * np.sum([*contact.wear_rates.values()], axis=0)
        pressure = contact.pressure
        pressed: Array = (pressure > 0).astype(float)
        if self.fills and pressure.any():
            # All or nothing would make it come and go where it just touches.
            pressed = pressure * np.sum(pressure) / np.sum(pressure**2)
        leaves = pressed * contact.state[THICKNESS.name] / self.ejection_length
        return {THICKNESS.name: contact.speed * (caught - leaves)}
