"""Times and distances of a run: moments at which rates are evaluated, and intervals between."""

from __future__ import annotations

from dataclasses import dataclass

from tribo.core.state import State


@dataclass(frozen=True)
class Moment:
    """When rates are evaluated (s, m), and the mean speed of the step (m/s), 0 at rest.

    Laws and effects read this speed where the motion does not state the speeds of its cycle.
    """

    time: float
    distance: float
    speed: float


@dataclass(frozen=True)
class Interval:
    """The time between two moments: a sliding path, or a rest.

    Parameters
    ----------
    time, distance : float
        Where it begins, in s and m.
    end_time : float
        When it ends, in s.
    slides : float
        Its sliding distance, in m; 0 at rest.
    load_factor : float
        Load factor by effects over it.
    """

    time: float
    distance: float
    end_time: float
    slides: float
    load_factor: float = 1.0

    @property
    def rests(self) -> bool:
        """Whether nothing slides."""
        return self.slides == 0

    @property
    def speed(self) -> float:
        """Its mean speed, in m/s."""
        return self.slides / (self.end_time - self.time)

    @property
    def length(self) -> float:
        """Its length in the unit that rates are per: m, or s at rest."""
        return self.end_time - self.time if self.rests else self.slides

    @property
    def end(self) -> Moment:
        """The moment at its end."""
        return self.at(1.0)

    def at(self, passed: float) -> Moment:
        """Return the moment at which a part of it has passed."""
        time = (1 - passed) * self.time + passed * self.end_time
        return Moment(time, self.distance + passed * self.slides, self.speed)


def interval_from(state: State, slides: float, time: float) -> Interval:
    """Return the interval of a step from `state` that slides a distance (m) until a time (s)."""
    return Interval(state.time, state.distance, time, slides, state.load_factor)
