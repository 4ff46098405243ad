"""What drags a contact to and fro, and the first loading from rest that a whole cycle follows."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Mapping
from functools import lru_cache
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import Tag, model_validator
from scipy.optimize import brentq
from tribo import Array, Grid, Material, Quantity, Table
from tribo.kernel_api import NUMBER, ONE_OR_STAGES, STAGES, Held, around, held, readonly

from tribo_fretting.cerruti import cerruti, tangential_compliances
from tribo_fretting.projected_cg import TOLERANCE, Drag, dragged

Amplitude = Annotated[float, Quantity("m", above=0, usual=(1e-10, 1e-3))]


class AmplitudeStage(Table):
    """A stage of an amplitude that changes over time: it is held until a time."""

    until: Annotated[float, Quantity("s", above=0)]
    """When it ends."""
    amplitude: Amplitude
    """Amplitude of the motion to each side."""


class Drive(Table):
    """The drive of a contact to and fro along x."""

    amplitude: Annotated[
        Annotated[Amplitude, Tag(NUMBER)] | Annotated[tuple[AmplitudeStage, ...], Tag(STAGES)],
        ONE_OR_STAGES,
    ]
    """Amplitude of the motion to each side: a number, or a list of stages, each a table with
    `until` and `amplitude`."""
    stiffness: Annotated[float, Quantity("N/m", above=0, usual=(1e6, 1e12))] | None = None
    """Stiffness of the rig in series with the contact, along x: `amplitude` then moves the
    rig. A rigid rig if left out."""
    force_amplitude: Annotated[float, Quantity("N", above=0)] | None = None
    """Tangential force at which the motion turns back before its amplitude is reached."""
    direction: Literal["free", "along"] = "along"
    """Whether points slip along x alone, as in closed forms, or as their traction leads them."""
    allow_narrow_ring: bool = False
    """Whether a first contact is accepted whose ring of slip is narrower than four cells."""

    @model_validator(mode="after")
    def _stages_rise(self) -> Self:
        _ = self.held
        return self

    @property
    def held(self) -> Held:
        """The amplitudes, in m, and until when each is held, in s."""
        return held("amplitude", self.amplitude)

    def amplitude_at(self, time: float) -> float:
        """Return the amplitude (m) up to a time, in s; the last one beyond."""
        return self.held.rates[self._stage_at(time)]

    def amplitude_path(self, time: float) -> str:
        """Return the path to the amplitude up to a time, in s."""
        one = isinstance(self.amplitude, float)
        return "amplitude" if one else f"amplitude.{self._stage_at(time) + 1}.amplitude"

    def _stage_at(self, time: float) -> int:
        return min(bisect_left(self.held.ends, time), len(self.held.ends) - 1)

    @property
    def components(self) -> int:
        """Number of components of the traction."""
        return 2 if self.direction == "free" else 1

    def rig(self, grid: Grid) -> float:
        """Return by how much the rig gives way under a traction of 1 on one cell, in m/Pa."""
        return grid.cell_area / self.stiffness if self.stiffness else 0.0

    def first_loading(
        self, grid: Grid, materials: Mapping[str, Material], limit: Array, amplitude: float
    ) -> Drag:
        """Drag a contact from rest to the reversal, where the traction is q₁ and the slip s₁.

        Under a steady pressure a motion between ±δ leads to the tractions ±q₁, and each point slips
        4 s₁ a cycle: Masing's rule. With a rig the contact moves by δ less Q/k; with a force
        amplitude δ is less, if Q reaches it.
        The limit μp (Pa) has the shape of the grid, the amplitude δ is in m. The answer has both
        components of the traction; beyond the contact it is 0.
        """
        compliances = tangential_compliances(materials.values())
        return _first_loading(self, grid, compliances, limit.tobytes(), amplitude)


@lru_cache(maxsize=8)
def _first_loading(
    drive: Drive, grid: Grid, compliances: tuple[float, float], limits: bytes, amplitude: float
) -> Drag:
    limit, rig = np.frombuffer(limits).reshape(grid.cells), drive.rig(grid)
    box = around(limit > 0, 0)
    operator = cerruti(box.shape, grid.spacing, compliances, drive.components, rig)

    def loaded(displacement: float) -> Drag:
        return dragged(operator, displacement, limit[box.slices])

    def excess(displacement: float) -> float:
        force = np.sum(loaded(displacement).traction[0]) if displacement else 0.0
        return float(force) * grid.cell_area - (drive.force_amplitude or np.inf)

    if drive.force_amplitude and excess(amplitude) > 0:
        amplitude = brentq(excess, 0.0, amplitude, xtol=TOLERANCE * amplitude)
    inside = loaded(amplitude)
    traction = np.zeros((2, *grid.cells))
    traction[: drive.components] = box.embed(inside.traction)
    slip = readonly(box.embed(inside.slip))
    return Drag(amplitude, readonly(traction), slip, inside.iterations)
