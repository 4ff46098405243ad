"""Partial slip of a contact that is moved to and fro: the effect that wear laws act through."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from pydantic import ConfigDict
from tribo import (
    LOCAL_SLIP,
    Array,
    CaseError,
    ContactConditions,
    ContactSystem,
    Effect,
    Field,
    Mask,
)

from tribo_fretting.cerruti import dundurs_beta
from tribo_fretting.drive import Drive
from tribo_fretting.loading import first_loading
from tribo_fretting.projected_cg import Drag
from tribo_fretting.slip_adjoint import pulled_back

TRACTION_X = Field("traction_x", "Pa", "Friction traction along x at the end of a stroke.")
TRACTION_Y = Field("traction_y", "Pa", "Friction traction along y at the end of a stroke.")
UNLIKE = 0.05
"""Largest |β|μ, by which the pressure would be off without the coupling of unlike bodies."""
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
    Mindlin, R. D., Deresiewicz, H. (1953), J. Appl. Mech. 20, 327-344. Masing, G. (1926),
    Eigenspannungen und Verfestigung beim Messing, Proc. 2nd Int. Congr. Appl. Mech., 332-335.
    Johnson, K. L. (1985), Contact Mechanics, chapters 3 and 7.
    """

    model_config = ConfigDict(json_schema_extra={"examples": [{"amplitude": "10 um"}]})

    type = "fretting.partial_slip"
    provides = (LOCAL_SLIP, TRACTION_X, TRACTION_Y)
    requires = ("friction_coefficient",)

    def check(self, system: ContactSystem, swept: frozenset[str], solver: str) -> None:
        """Refuse all but two half-spaces whose points stay in contact."""
        if solver != "dcfft":
            raise CaseError(
                f"{solver!r} has no tangential displacement; partial slip needs two half-spaces: "
                'contact.type = "dcfft"',
                "contact.type",
            )
        if system.coatings:
            raise CaseError(
                f"{min(system.coatings)!r} has an elastic layer; partial slip needs two "
                "half-spaces: give the layer no modulus of its own",
                "bodies",
            )
        if swept:
            raise CaseError(
                f"points of {min(swept)!r} pass through the contact, and in partial slip they stay "
                'in it; use kinematics.type = "fretting.motion"',
                "kinematics",
            )

    def fields(self, contact: ContactConditions) -> Mapping[str, Mapping[str, Array]]:
        """Return the slip per metre of the motion and the traction at the end of a stroke."""
        _, drag, amplitude = self._loaded(contact)
        if contact.distance == 0:
            for end in self.held.ends:
                self._check_first_contact(replace(contact, time=end))
        slip = np.clip(drag.slip / amplitude, 0.0, 1.0)
        answers = zip(self.provides, (slip, *drag.traction), strict=True)
        return {field.name: dict.fromkeys(contact.materials, of) for field, of in answers}

    def pull_back(
        self, contact: ContactConditions, cotangents: Mapping[str, Mapping[str, Array]]
    ) -> Mapping[str, Array | float]:
        """Return derivatives in pressure, friction, elastic constants and numbers of the motion."""
        limit, drag, amplitude = self._loaded(contact)
        body, friction = next(iter(contact.fields["friction_coefficient"].items()))
        names = [field.name for field in self.provides[: 1 + self.components]]
        by = np.array([sum(cotangents[name].values()) for name in names])
        by[0] = np.where(drag.slip < amplitude, by[0] / amplitude, 0.0)
        by_limit, numbers = pulled_back(self, contact, limit, drag, by)
        by_amplitude = numbers.pop("amplitude") - np.sum(by[0] * drag.slip) / amplitude
        return {
            "pressure": friction * by_limit,
            f"fields.friction_coefficient.{body}": contact.pressure * by_limit,
            self.amplitude_path(contact.time): by_amplitude,
            **numbers,
        }

    def _loaded(self, contact: ContactConditions) -> tuple[Array, Drag, float]:
        """Return the limit μp, the first loading and the amplitude."""
        friction = next(iter(contact.fields["friction_coefficient"].values()))
        self._check_friction(contact, friction)
        limit, amplitude = friction * contact.pressure, self.amplitude_at(contact.time)
        drag = first_loading(self, contact.grid, contact.materials, limit, amplitude)
        return limit, drag, amplitude

    def _check_friction(self, contact: ContactConditions, friction: Array) -> None:
        cap, pressure = contact.system.cap, contact.pressure
        if cap is not None and np.max(pressure) >= cap * (1 - 1e-9):
            raise CaseError(
                f"the pressure reaches the hardness of {cap / 1e9:.3g} GPa, where friction is not "
                "in proportion to it; partial slip needs elastic bodies: lower load.normal, or "
                "leave the hardness out",
                "bodies",
            )
        coupled = abs(dundurs_beta(contact.materials.values())) * float(np.max(friction))
        if coupled > UNLIKE:
            raise CaseError(
                f"the materials are too unlike: traction and pressure act on each other, and "
                f"without that the pressure would be off by about {100 * coupled:.2g} % (Dundurs' "
                f"|β| times μ; {100 * UNLIKE:g} % is allowed)",
                "bodies",
            )

    def _check_first_contact(self, contact: ContactConditions) -> None:
        drag, path = self._loaded(contact)[1], f"kinematics.{self.amplitude_path(contact.time)}"
        pressed, grid = contact.pressure > 0, contact.grid
        half_width = 0.5 * np.count_nonzero(pressed.any(axis=1)) * grid.spacing[0]
        if drag.displacement > PART * half_width:
            raise CaseError(
                f"the contact moves by {1e6 * drag.displacement:.3g} µm to each side, more than "
                f"half of its half-width of {1e6 * half_width:.3g} µm; use kinematics.type = "
                '"reciprocating" with positions, which is gross slip',
                path,
            )
        stuck = pressed & (drag.slip == 0)
        slipping = np.count_nonzero(pressed & ~stuck)
        rough = slipping and contact.system.curvature is None
        if self.allow_narrow_ring or rough or not stuck.any():
            return
        ring = slipping / (np.pi / 8 * (_faces(pressed) + _faces(stuck)))
        if ring < NARROW:
            raise CaseError(
                f"the ring of slip is {ring:.2g} cells wide; it must be {NARROW:g} cells wide at "
                "least: take a larger amplitude, or smaller cells",
                path,
            )


def _faces(cells: Mask) -> int:
    """Return how many faces some cells have towards others; 4/π of its length of a circle."""
    return sum(int(np.count_nonzero(np.diff(cells, axis=axis))) for axis in (0, 1))
