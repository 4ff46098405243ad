"""Hold what an exposure answers to the contract."""

from __future__ import annotations

import numpy as np

from tribo.core.arrays import Array, readonly
from tribo.core.contact import WearCompliance
from tribo.core.errors import PluginError
from tribo.core.grid import Grid
from tribo.motion.exposure import Exposure
from tribo.motion.kinematics import Kinematics
from tribo.simulation import answers
from tribo.simulation.calling import calling, named


class CheckedExposure(Exposure):
    """An exposure of which every answer is checked; what is wrong names the motion it is from.

    Parameters
    ----------
    exposure : Exposure
        What is asked.
    motion : Kinematics
        Where it is from.
    body : str
        Whose it is.
    grid : Grid
        The window.
    """

    def __init__(self, exposure: Exposure, motion: Kinematics, body: str, grid: Grid) -> None:
        self.swept = exposure.swept
        self.shape_stays = exposure.shape_stays
        self._asked = exposure
        self._motion = motion
        self._who = f"{named(motion)}, for body {body!r},"
        self._cells = grid.cells
        # One value for all x where every point of the track sees the same.
        self._own = (1, grid.cells[1]) if exposure.swept else grid.cells

    def average(self, rate: Array) -> Array:
        """Return the rate each point of the body sees, on its own surface."""
        asked = readonly(rate)
        with calling(self._motion):
            answer = self._asked.average(asked)
        if answer is asked and not self.swept:
            # What was held to the contract as a law's answer.
            return asked
        average, least, _ = answers.field(self._who, "an average", answer, self._own)
        if least < 0 <= np.min(rate):
            raise PluginError(
                f"{self._who} gave a negative average ({least:.3g}) of what is nowhere negative"
            )
        return average

    def envelope(self, field: Array) -> Array:
        """Return the largest value each point of the body meets, on its own surface."""
        with calling(self._motion):
            answer = self._asked.envelope(readonly(field))
        return answers.field(self._who, "an envelope", answer, self._own)[0]

    def volume(self, depth: Array) -> float:
        """Return the volume of a depth on the body's own surface, in m³."""
        with calling(self._motion):
            answer = self._asked.volume(readonly(depth))
        return answers.number(self._who, "a volume", answer)

    def compliance(self, derivative: Array, pressure: Array) -> WearCompliance | None:
        """Return the wear per metre of sliding as a compliance, or None."""
        asked = readonly(derivative)
        with calling(self._motion):
            answer = self._asked.compliance(asked, readonly(pressure))
        if answer is None:
            return None
        if not isinstance(answer, WearCompliance):
            kind = type(answer).__name__
            raise PluginError(f"{self._who} gave a {kind} instead of a WearCompliance")
        local, least = answer.local, 0.0
        if local is not asked:
            local, least, _ = answers.field(self._who, "a local compliance", local, self._cells)
        swept, lowest, _ = answers.field(
            self._who, "a swept compliance", answer.swept, self._cells[1:]
        )
        if min(least, lowest) < 0:
            raise PluginError(f"{self._who} gave a negative compliance ({min(least, lowest):.3g})")
        return WearCompliance(local, swept)
