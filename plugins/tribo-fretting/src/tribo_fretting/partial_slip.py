"""Partial slip of a contact that is moved to and fro: the effect that wear laws act through."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from tribo import LOCAL_SLIP, Array, CaseError, ContactConditions, ContactSystem, Effect

from tribo_fretting.cerruti import dundurs_beta
from tribo_fretting.columns import COLUMNS, SLIP, TRACTION_X, TRACTION_Y
from tribo_fretting.drive import Drive
from tribo_fretting.projected_cg import Drag
from tribo_fretting.slip_adjoint import pulled_back

UNLIKE = 0.05
"""Largest |β|μ: without the coupling the pressure is off by as much, the energy by 0.6 %."""
NARROW = 4.0
"""Cells of the ring of slip below which the energy of a cycle is off by 3 % and more."""
PART = 0.5
"""Displacement over the contact's half-width up to which the bodies stay where they touched."""


class PartialSlip(Effect, Drive):
    """Points slip ψ = s₁/δ for each metre of a motion between ±δ; 0 where they stick.

    s₁ = δ − A q₁ is the slip of a contact that is dragged by δ from rest, q₁ its traction with
    |q₁| ≤ μp, and A the displacement of two half-spaces under it, after Cerruti. Under a steady
    load, for bodies of like material, a cycle slips 4 s₁ at each point (Masing); its path is 4 δ.
    In gross slip ψ = 1 − A(μp)/δ. Every wear law acts at depth rates of ψ r(p).

    Valid for slip that is short beside the contact, a load that is steady over a cycle, Coulomb
    friction, elastic half-spaces. The traction does not act back on the pressure.

    References
    ----------
    Masing, G. (1926), Eigenspannungen und Verfestigung beim Messing, Proc. 2nd Int. Congr. Appl.
    Mech., 332-335. Johnson, K. L. (1985), Contact Mechanics, chapters 3 and 7.

    Examples
    --------
    >>> from tribo_fretting.partial_slip import PartialSlip
    >>> slip = PartialSlip(amplitude=[{"until": "1 h", "amplitude": "3 um"}])
    >>> slip.amplitude_at(time=60.0)
    3e-06
    """

    examples = ({"amplitude": "10 um"},)
    type = "fretting.partial_slip"
    provides = (LOCAL_SLIP, TRACTION_X, TRACTION_Y, SLIP)
    requires = ("friction_coefficient",)
    columns = COLUMNS

    def check(self, system: ContactSystem, swept: frozenset[str], solver: str) -> None:
        """Refuse all but two half-spaces whose points stay in contact."""
        if solver != "dcfft":
            raise CaseError(
                f'{solver!r} has no tangential displacement; take contact.type = "dcfft"',
                "contact.type",
            )
        if system.coatings:
            raise CaseError(
                f"{min(system.coatings)!r} has an elastic layer; give it no modulus of its own",
                "bodies",
            )
        if swept:
            raise CaseError(
                f"points of {min(swept)!r} pass through the contact; use kinematics.type = "
                '"fretting.motion", in which they stay in it',
                "kinematics",
            )

    def fields(self, contact: ContactConditions) -> Mapping[str, Mapping[str, Array]]:
        """Return the slip per metre of the motion and the traction at the end of a stroke."""
        _, drag, amplitude = self._loaded(contact)
        if contact.distance == 0:
            for end in self.held.ends:
                self._check_first_contact(replace(contact, time=end))
        slip = np.clip(drag.slip / amplitude, 0.0, 1.0)
        answers = zip(self.provides, (slip, *drag.traction, 4 * drag.slip), strict=True)
        return {field.name: dict.fromkeys(contact.materials, of) for field, of in answers}

    def pull_back(
        self, contact: ContactConditions, cotangents: Mapping[str, Mapping[str, Array]]
    ) -> Mapping[str, Array | float]:
        """Return derivatives in pressure, friction, elastic constants and numbers of the motion."""
        limit, drag, amplitude = self._loaded(contact)
        body, friction = next(iter(contact.fields["friction_coefficient"].items()))
        local, x, y, slip = (sum(cotangents[field.name].values()) for field in self.provides)
        local = np.where(drag.slip < amplitude, local / amplitude, 0.0)
        by = np.array([local + 4 * slip, x, y][: 1 + self.components])
        by_limit, numbers = pulled_back(self, contact, limit, drag, by)
        by_amplitude = numbers.pop("amplitude") - np.sum(local * drag.slip) / amplitude
        return {
            "pressure": friction * by_limit,
            f"fields.friction_coefficient.{body}": contact.pressure * by_limit,
            self.amplitude_path(contact.time): by_amplitude,
            **numbers,
        }

    def _loaded(self, contact: ContactConditions) -> tuple[Array, Drag, float]:
        """Return the limit μp, the first loading and the amplitude."""
        friction = next(iter(contact.fields["friction_coefficient"].values()))
        cap, pressure, materials = contact.system.cap, contact.pressure, contact.materials
        if np.any(friction[pressure > 0] == 0):
            raise CaseError("friction is 0 at a point of the contact; give more than 0", "friction")
        if cap is not None and np.max(pressure) >= cap * (1 - 1e-9):
            raise CaseError(
                f"the pressure reaches the hardness of {cap / 1e9:.3g} GPa, where friction does "
                "not go with it: lower load.normal, or leave the hardness out",
                "bodies",
            )
        coupled = abs(dundurs_beta(materials.values())) * float(np.max(friction))
        if coupled > UNLIKE:
            raise CaseError(
                "the materials are too unlike: traction changes the pressure by about "
                f"{100 * coupled:.2g} % (Dundurs' |β| times μ); {100 * UNLIKE:g} % is allowed",
                "bodies",
            )
        limit, amplitude = friction * pressure, self.amplitude_at(contact.time)
        return limit, self.first_loading(contact.grid, materials, limit, amplitude), amplitude

    def _check_first_contact(self, contact: ContactConditions) -> None:
        _, drag, amplitude = self._loaded(contact)
        by_force = drag.displacement < amplitude
        path = "force_amplitude" if by_force else self.amplitude_path(contact.time)
        pressed, stuck = contact.pressure > 0, (contact.pressure > 0) & (drag.slip == 0)
        whole, inner = (0.5 * np.count_nonzero(each.any(axis=1)) for each in (pressed, stuck))
        slip, half_width = np.max(drag.slip[pressed]), whole * contact.grid.spacing[0]
        if slip > PART * half_width:
            raise CaseError(
                f"points slip by {1e6 * slip:.3g} µm to each side, more than half of the contact's "
                f"half-width of {1e6 * half_width:.3g} µm; use kinematics.type = "
                '"reciprocating" with positions, which is gross slip',
                f"kinematics.{path}",
            )
        rough = contact.system.curvature is None and np.any(drag.slip[pressed])
        if whole - inner < NARROW and inner and not (rough or self.allow_narrow_ring):
            ring = (
                f"{whole - inner:g} cells wide along x" if inner < whole else "nowhere: all sticks"
            )
            raise CaseError(
                f"the ring of slip is {ring}; it must be {NARROW:g} cells wide at least: take a "
                f"larger {path.split('.')[-1]}, or smaller cells",
                f"kinematics.{path}",
            )
