"""Friction traction in proportion to the pressure."""

from __future__ import annotations

from collections.abc import Mapping

from tribo import Array, ContactConditions, Effect, Field

TRACTION = Field("friction_traction", "Pa", "Magnitude of the friction traction, for both bodies.")
SLOPE = Field(
    "friction_traction_slope", "1", "Derivative of the traction in pressure.", typical=0.3
)


class FrictionTraction(Effect):
    """τ = μ p, in Pa, and its slope dτ/dp = μ.

    Valid for gross sliding with a coefficient of friction μ that does not
    depend on pressure, so that no part of the contact sticks. The traction
    does not act back on the contact.

    References
    ----------
    Johnson, K. L. (1985), Contact Mechanics, Cambridge, section 7.1.

    Examples
    --------
    >>> from tribo_energy.traction import FrictionTraction
    >>> steel = dict.fromkeys(("ball", "disk"), tribo.materials["100Cr6"])
    >>> system = tribo.ContactSystem(tribo.Grid("1 mm", 4), 115e9, load=10.0, materials=steel)
    >>> fields = {"friction_coefficient": dict.fromkeys(steel, np.full((1, 1), 0.3))}
    >>> pressure, swept = np.full((4, 4), 10e6), frozenset({"disk"})
    >>> contact = tribo.ContactConditions(system, pressure, 0.1, 0.0, 0.0, swept, fields=fields)
    >>> traction = FrictionTraction().fields(contact)["friction_traction"]["disk"]
    >>> round(float(1e-6 * traction.max()), 3)  # in MPa
    3.0
    """

    type = "energy.friction_traction"
    reach = "point"

    provides = (TRACTION, SLOPE)
    requires = ("friction_coefficient",)

    def fields(self, contact: ContactConditions) -> Mapping[str, Mapping[str, Array]]:
        """Return the traction and its slope, the same for each body."""
        friction = contact.fields["friction_coefficient"]
        traction = {name: friction[name] * contact.pressure for name in contact.materials}
        return {TRACTION.name: traction, SLOPE.name: friction}
