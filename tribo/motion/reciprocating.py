"""Back and forth over a stroke, as in a ball-on-disk oscillation tester."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import Field, Tag, field_validator, model_validator

from tribo.core.grid import Grid
from tribo.core.loads import NUMBER, ONE_OR_STAGES, STAGES
from tribo.core.table import Table
from tribo.core.units import Quantity
from tribo.motion.cycle import Position, Speeds
from tribo.motion.exposure import Exposure, Passing, Track, one_swept_body
from tribo.motion.held import HeldMotion
from tribo.motion.stroke import Stroke, odd

LONG, FEW = 4.0, 17
"""Stroke in half-widths up to which an estimate takes positions, and how many: eight a contact's
width."""
PHASES = 6
"""Speeds of a sinusoidal cycle: means of its powers up to the third are exact to 1e-6."""
SAMPLES = 16
"""Of a sinusoidal half cycle, for each cell of the stroke: speeds are exact to 1e-4."""


class FrequencyStage(Table):
    """A stage of a frequency that changes over time: it is held until a time.

    Examples
    --------
    >>> slide = tribo.FrequencyStage(until="10 s", frequency="5 Hz")
    >>> stages = [slide, tribo.FrequencyStage(until="30 s", frequency=0)]
    >>> motion = tribo.Reciprocating(stroke="1 mm", frequency=stages, duration="30 s")
    >>> motion.distance_at(20.0)  # m, during the rest
    0.1
    """

    until: Annotated[float, Quantity("s", above=0)]
    """When it ends."""
    frequency: Annotated[float, Quantity("Hz", at_least=0, usual=(1e-6, 1e5))]
    """Full cycles, back and forth, per second; 0 for a rest."""


class Reciprocating(HeldMotion):
    """Stroke S at frequency f: mean speed 2 S f, one body swept over the stroke.

    With ``waveform = "sinusoidal"`` the position is −(S/2) cos(2πft) and the speed
    ``πSf |sin(2πft)|``. The track average is over positions, so the waveform changes only the
    distance at times inside a half cycle, and the speeds at which effects and laws are evaluated.

    The track average is the paper's model, and makes a groove too deep at mid-stroke. One as deep
    as the elastic approach is 4 % too deep where S is 10 half-widths of the contact and 12 % where
    it is 4; one several times deeper, twice as much, where both bodies wear alike. Resolved into
    `positions`, as a run does by itself where the stroke is shorter than 20 lengths of the first
    contact, it holds for any stroke, gross slip in fretting among them.

    Examples
    --------
    >>> motion = tribo.Reciprocating(stroke="2 mm", frequency="25 Hz", cycles=1000)
    >>> motion.end_time, motion.distance_at(1.0)  # s, m in a second
    (40.0, 0.1)
    """

    examples = ({"stroke": "2 mm", "frequency": "25 Hz", "cycles": 100},)
    type = "reciprocating"
    _rate_key, _laps_key = "frequency", "cycles"
    turns_back = True
    stroke: Annotated[float, Quantity("m", above=0, usual=(1e-9, 1.0))]
    """Distance between the two points of reversal."""
    frequency: Annotated[
        Annotated[float, Quantity("Hz", above=0, usual=(1e-6, 1e5)), Tag(NUMBER)]
        | Annotated[tuple[FrequencyStage, ...], Tag(STAGES)],
        ONE_OR_STAGES,
    ]
    """Full cycles, back and forth, per second: a number or, at a constant speed along the stroke, a
    list of stages, each a table with `until` and `frequency`, 0 for a rest."""
    cycles: Annotated[float, Quantity("1", above=0, also=("lap",))] | None = None
    """How many full cycles it runs."""
    waveform: Literal["constant_speed", "sinusoidal"] = "constant_speed"
    """How the speed varies along the stroke."""
    positions: Annotated[int, Field(ge=3)] | Literal["cells", "average", "auto"] = "auto"
    """In how many positions of a cycle the contact is solved, an odd number, or ``"cells"`` for
    every cell of the stroke; ``"average"`` takes the track average for all of them. ``"auto"`` is
    the average from 20 lengths of the first contact on, else positions 0.425 of its half-width
    apart; the motion itself takes the average until a case is composed with it."""

    @model_validator(mode="after")
    def _one_frequency(self) -> Self:
        if self.waveform == "sinusoidal" and not isinstance(self.frequency, float):
            raise ValueError(
                'a frequency in stages is for waveform = "constant_speed": leave waveform out, or '
                'give the path as type = "measured"'
            )
        return self

    _middle = field_validator("positions")(odd)

    @property
    def track_extent(self) -> float:
        """The stroke, in m."""
        return self.stroke

    @property
    def lap(self) -> float:
        """Path of a full cycle: two strokes, in m."""
        return 2 * self.stroke

    @property
    def end_time(self) -> float:
        """Time at which the motion ends, in s."""
        slid = self.distance
        cycles = self.cycles if slid is None else self._half_cycles(self.metres(slid)) / 2
        return self._held.end("frequency", "cycles", self.duration, cycles)

    def distance_at(self, time: float) -> float:
        """Return the sliding distance until `time`, in m."""
        half_cycles = 2 * self._held.by(time)
        if self.waveform == "constant_speed":
            return half_cycles * self.stroke
        whole = math.floor(half_cycles)
        return (whole + math.sin(0.5 * math.pi * (half_cycles - whole)) ** 2) * self.stroke

    def time_at(self, distance: float) -> float:
        """Return the first time at which `distance` is reached, in s."""
        return self._held.reached(self._half_cycles(distance) / 2)

    def _half_cycles(self, distance: float) -> float:
        strokes = distance / self.stroke
        if self.waveform == "constant_speed":
            return strokes
        whole = math.floor(strokes)
        return whole + math.asin(math.sqrt(strokes - whole)) / (0.5 * math.pi)

    def _sine(self) -> Speeds:
        """Return speeds of a sinusoidal cycle, at Gauss points of the phase."""
        nodes, weights = np.polynomial.legendre.leggauss(PHASES)
        # From a reversal to mid-stroke; distance goes as the integral of the speed over the phase.
        sines = np.sin(0.25 * math.pi * (nodes + 1))
        shares = weights * sines / np.sum(weights * sines)
        largest = math.pi * self.stroke * self._held.rates[0]
        return [(largest * float(s), float(w)) for s, w in zip(sines, shares, strict=True)]

    def cycle(self, grid: Grid) -> Sequence[Position]:
        """Return the positions along the stroke, with the mean speed about each."""
        even = self.waveform == "constant_speed"
        if self._averages:
            return [Position(speeds=None if even else self._sine())]
        stroke = self._stroke(grid)
        if even:
            return [Position(float(share)) for share in stroke.shares]
        samples = SAMPLES * math.ceil(self.stroke / grid.spacing[0])
        phases = np.linspace(-0.5 * math.pi, 0.5 * math.pi, samples + 1)
        times = phases / (2 * math.pi * self._held.rates[0])
        return stroke.passed(times, 0.5 * self.stroke * np.sin(phases))

    def coarsened(self, half_width_x: float) -> Reciprocating:
        """Return the motion at its mean speed, averaged, or a short stroke at few positions."""
        few = "average" if self._averages or self.stroke > LONG * half_width_x else FEW
        changes = {"positions": few, "waveform": "constant_speed"}
        return self.model_copy(update=changes)

    def exposures(self, grid: Grid, bodies: Sequence[str]) -> Mapping[str, Exposure]:
        """Return a track as long as the stroke for the swept body, or its rows along the stroke."""
        if self._averages:
            return one_swept_body(grid, bodies, self.swept, Track(grid, self.stroke))
        passing = Passing(grid, self._stroke(grid).starts, self.stroke)
        return one_swept_body(grid, bodies, self.swept, passing)

    @property
    def _averages(self) -> bool:
        return self.positions in ("average", "auto")

    def _stroke(self, grid: Grid) -> Stroke:
        return Stroke(self.stroke, grid.spacing[0], self.positions, grid.period)
