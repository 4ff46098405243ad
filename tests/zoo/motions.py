"""Motions that do not move as they say, and exposures that answer nonsense."""

import numpy as np
from zoo.components import ZOO, raising

from tribo import Stationary, Track, Unidirectional, WearCompliance


class Slide(Unidirectional):
    speed: float = 0.1
    track_length: float = 0.02
    distance: float = 2.0


def path(change):
    return {"distance_at": lambda self, t: change(t, Unidirectional.distance_at(self, t))}


def stopping(time, distance):
    if abs(time - 7) < 0.1:
        raise OverflowError("too late")
    return distance


for name, words, saved, parts in (
    ("backwards", "it must slide on from 0", False, path(lambda t, s: -s)),
    ("stands_still", "slides from 0 m to 0 m", False, path(lambda t, s: 0.0)),
    ("no_path", "'distance_at' at 0 s that is a NoneType", False, path(lambda t, s: None)),
    # Between the times that are tried at first.
    ("turns_back", "does not grow", True, path(lambda t, s: s if abs(t - 7) > 0.1 else 0.0)),
    ("stops", "raised OverflowError: too late", True, path(stopping)),
    ("ends_before", "'end_time' that is -3.0; ", False, {"end_time": property(lambda self: -3.0)}),
    ("no_inverse", "not the inverse", False, {"time_at": lambda self, s: 5 * s}),
    ("loses_time", "puts 0.", True, {"time_at": lambda self, s: 10 * s if 80 * s % 1 == 0 else 0}),
    ("no_exposures", "gave exposures of a NoneType", False, {"exposures": lambda *given: None}),
    (
        "forgets_disk",
        "gave exposures of ['ball']",
        False,
        {"exposures": lambda self, grid, bodies: {"ball": Stationary(grid)}},
    ),
    (
        "exposes_a_class",
        "as the exposure of body 'disk'",
        False,
        {"exposures": lambda self, grid, bodies: {"ball": Stationary(grid), "disk": Track}},
    ),
):
    ZOO.bad(name, Slide, words, saved=saved, **parts)


def exposed(name, words, **parts):
    """Keep a motion whose first body has an exposure with other parts."""
    wrong = type(name, (Stationary,), parts)
    ZOO.bad(
        name,
        Slide,
        words,
        exposures=lambda self, grid, bodies: {bodies[0]: wrong(grid), bodies[1]: Track(grid, 0.02)},
    )


def doubled(self, rate):
    rate *= 2
    return rate


AVERAGE = "'average' for body 'ball' that"
exposed("average_negative", AVERAGE, average=lambda self, rate: -np.abs(rate))
exposed("average_writes", "read-only", average=doubled)
exposed("average_raises", "raised IndexError: out", average=raising(IndexError("out")))
exposed("volume_nan", "'volume' for body 'ball' that is nan", volume=lambda self, depth: np.nan)
exposed(
    "envelope_short",
    "'envelope' for body 'ball' that is float64 of shape (23, 24)",
    envelope=lambda self, field: field[1:],
)
exposed(
    "compliance_array",
    "ndarray as a compliance for body 'ball'",
    compliance=lambda self, k, p: k,
)
exposed(
    "compliance_below_0",
    "'local' for body 'ball' that is -",
    compliance=lambda self, k, p: WearCompliance(-k, np.zeros(24)),
)
