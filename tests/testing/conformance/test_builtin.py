"""Every built-in component conforms, under the same checks as a stranger's."""

import pytest

from tribo.contact.winkler import Winkler
from tribo.motion.closed_track import Unidirectional
from tribo.motion.measured import Measured
from tribo.motion.planar import Planar
from tribo.motion.reciprocating import Reciprocating
from tribo.registry.registry import Registry
from tribo.testing import check

BACK_AND_FORTH = {"stroke": "2 mm", "frequency": "25 Hz"}
ROUND = {"speed": "0.1 m/s", "track_radius": "16 mm", "distance": "10 m"}
LAYER = {"thickness": 1e-4, "young": 1e10, "poisson": 0.3}
TURN = {"path": "circle", "extent": ("0.2 mm", "0.1 mm"), "speed": "20 mm/s", "revolutions": 9}
TRIANGLE = {"path": [(0, 0), (2e-4, 0), (0, 1e-4)], "extent": None, "positions": "cells"}
MORE = {
    Winkler: [{}, {"layer": LAYER}],
    Reciprocating: [
        {**BACK_AND_FORTH, "duration": 200},
        {**BACK_AND_FORTH, "cycles": 5000, "waveform": "sinusoidal", "swept": "ball"},
        {**BACK_AND_FORTH, "stroke": "1 mm", "duration": 200, "positions": 15},
    ],
    Measured: [
        {"path": [(0, 0), (1, 1e-3), (3, 1e-3), (4, 0)], "cycles": 200, "positions": 15},
        {"path": [(2, 0), (5, 3e-4), (6, 1e-4), (9, 7e-4)], "positions": "cells", "swept": "ball"},
    ],
    Planar: [TURN, {**TURN, **TRIANGLE, "swept": "ball"}],
    Unidirectional: [ROUND, {**ROUND, "turns": True, "swept": "ball", "track_radius": "5 mm"}],
}
"""Configurations in place of the examples of a class."""


@pytest.mark.parametrize("cls", Registry.with_plugins().components.values())
def test_it_conforms(cls):
    report = check(cls, MORE.get(cls))
    assert report.ok, report
