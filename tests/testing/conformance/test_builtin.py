"""Every built-in component conforms, under the same checks as a stranger's."""

import pytest

from tribo.contact.dcfft import DcFft
from tribo.contact.periodic import Periodic
from tribo.contact.winkler import Winkler
from tribo.motion.closed_track import Rotating, Unidirectional
from tribo.motion.measured import Measured
from tribo.motion.planar import Planar
from tribo.motion.reciprocating import Reciprocating
from tribo.observers.progress import Progress
from tribo.registry.kinds import KINDS
from tribo.registry.registry import Registry
from tribo.surfaces.forms import Cylinder, Flat, Paraboloid, Sphere
from tribo.surfaces.height_map import HeightMap
from tribo.surfaces.pin import Pin
from tribo.surfaces.relief import Texture, Waves
from tribo.surfaces.rough import Rough
from tribo.testing import check
from tribo.wear.archard import Archard, Power
from tribo.wear.modified import Scaled
from tribo.wear.running_in import RunningIn, Smoothing

REFERENCE = {"k": "3e-16 1/Pa", "reference_pressure": "1 GPa"}
BACK_AND_FORTH = {"stroke": "2 mm", "frequency": "25 Hz"}
ROUND = {"speed": "0.1 m/s", "track_radius": "16 mm", "distance": "10 m"}
LAYER = {"thickness": 1e-4, "young": 1e10, "poisson": 0.3}

TURN = {"path": "circle", "extent": ("0.2 mm", "0.1 mm"), "speed": "20 mm/s", "revolutions": 9}
TRIANGLE = {"path": [(0, 0), (2e-4, 0), (0, 1e-4)], "extent": None, "positions": "cells"}
CHECKED = {
    Archard: [{"k": "3e-16 1/Pa"}, {"K": 1e-6}],
    Power: [{**REFERENCE, "p_exponent": 1.5}],
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
    Rotating: [ROUND],
    Planar: [TURN, {**TURN, **TRIANGLE, "swept": "ball"}],
    Unidirectional: [ROUND, {**ROUND, "turns": True, "swept": "ball", "track_radius": "5 mm"}],
    Sphere: [{"radius": "5 mm"}],
    Paraboloid: [{"radius_x": "5 mm", "radius_y": "10 mm"}],
    Cylinder: [{"radius": "5 mm", "axis": "x"}, {"radius": "5 mm", "degrees": 30}],
    Pin: [{"radius": "3 mm", "edge": "0.5 mm"}],
}
EXAMPLES = (Scaled, RunningIn, Smoothing, DcFft, Periodic)
EXAMPLES += (Flat, HeightMap, Rough, Texture, Waves, Progress)
CHECKED |= dict.fromkeys(EXAMPLES)


@pytest.mark.parametrize("cls", CHECKED)
def test_it_conforms(cls):
    report = check(cls, CHECKED[cls])
    assert report.ok, report


@pytest.mark.parametrize("kind", KINDS)
def test_none_is_left_out(kind):
    assert {*Registry.with_plugins().names(kind)} <= {cls.type for cls in CHECKED}
