"""The same case in another frame or other units has the same answer.

``TRIBO_EXAMPLES=200 pytest tests/invariance`` tries more than the few that a build does.
"""

import os

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from paper_models import flat, motion, named, small

from tribo.contact.dcfft import DcFft
from tribo.contact.periodic import Periodic
from tribo.contact.winkler import Winkler
from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.simulation.march import begin, march
from tribo.stepping.explicit import Explicit
from tribo.stepping.implicit import Implicit
from tribo.surfaces.surface import Surface
from tribo.wear.archard import Archard

# The solver stops at a residual of 1e-10, far below what is held against the answers.
TIGHT = 1e-10
CLOSE = 1e-6
"""Of the largest value: pressures of solves to a residual of 1e-10 differ by some 1e-8, and the
steps that follow them by no more than the step control lets through."""

few = settings(
    max_examples=int(os.environ.get("TRIBO_EXAMPLES", "6")),
    deadline=None,
    derandomize=True,
    database=None,
    suppress_health_check=list(HealthCheck),
)


class Bumps(Surface):
    """A ball with waves on it, given on the grid that it is asked for."""

    heights: object

    def height(self, grid):
        return self.heights


@st.composite
def wear_tests(draw):
    """A ball that is not symmetric, its material, load, wear, and how it is solved."""
    seed = draw(st.integers(0, 1000))
    return {
        "heights": _heights(seed, draw(st.sampled_from([0.0, 0.05, 0.3]))),
        "young": draw(st.floats(50e9, 400e9)),
        "poisson": draw(st.floats(0.0, 0.45)),
        "hardness": draw(st.sampled_from([None, 2e9, 8e9])),
        "load": draw(st.floats(20.0, 200.0)),
        "k": draw(st.sampled_from([(3e-16, 0.0), (3e-16, 1e-16)])),
        "contact": draw(st.sampled_from([DcFft, Periodic, Winkler])),
        "length": 1.0,
        "modulus": 1.0,
    }


def _heights(seed, rough):
    chance = np.random.default_rng(seed)
    x, y = Grid((1e-3, 1e-3), (24, 20)).mesh
    heights = -(x**2 / 10e-3 + y**2 / 14e-3)
    for _ in range(4):
        (u, v), phase = chance.integers(1, 4, 2), chance.uniform(0, 2 * np.pi)
        heights = heights + rough * 1e-6 * np.cos(2e3 * np.pi * (u * x + v * y) + phase)
    return heights


def model(test, *, swap=False, explicit=False):
    """Compose a test in units in which a metre is `length` and a pascal `modulus` of the old."""
    c, m = test["length"], test["modulus"]
    hardness = None if test["hardness"] is None else m * test["hardness"]
    material = Material(young=m * test["young"], poisson=test["poisson"], hardness=hardness)
    laws = [Archard(k=k / m) for k in test["k"]]
    bodies = [
        named("ball", Bumps(heights=c * test["heights"]), material, laws[0]),
        named("disk", flat(), material, laws[1]),
    ]
    contact = {
        DcFft: lambda: DcFft(tolerance=TIGHT),
        Periodic: lambda: Periodic(tolerance=TIGHT),
        Winkler: lambda: Winkler(modulus=1.3e15 * m / c),
    }[test["contact"]]
    # 0.1 m/s for 5 s, whatever the metre.
    stroke = 2e-3 * c
    return small(
        grid=Grid((1e-3 * c, 1e-3 * c), test["heights"].shape),
        load=m * c**2 * test["load"],
        bodies=bodies[::-1] if swap else bodies,
        contact=contact(),
        kinematics=motion(stroke=stroke, duration=5, swept="disk"),
        stepping=Explicit(time_step=0.5) if explicit else Implicit(),
        ends_at_window=True,
    )


def ran(test, **options):
    """Pressure, and wear and plastic depth of both bodies on the window, in the first units."""
    composed = model(test, **options)
    state = begin(composed)
    for accepted in march(composed, state):
        state = accepted.state
    c, m, shape = test["length"], test["modulus"], test["heights"].shape
    fields = [state.contact.pressure / m]
    for name in ("ball", "disk"):
        body = state.bodies[name]
        fields += [np.broadcast_to(body.wear, shape) / c, body.plastic / c]
    return fields


def agree(found, expected):
    for one, other in zip(found, expected, strict=True):
        assert one == pytest.approx(other, abs=CLOSE * max(np.abs(other).max(), 1e-12))


@few
@given(test=wear_tests(), axis=st.sampled_from([0, 1]))
def test_mirrored(test, axis):
    mirrored = ran({**test, "heights": np.flip(test["heights"], axis)})
    agree([np.flip(field, axis) for field in mirrored], ran(test))


@few
@given(test=wear_tests())
def test_bodies_in_the_other_order(test):
    agree(ran(test, swap=True), ran(test))


@few
@given(test=wear_tests(), length=st.floats(1e-2, 1e2), modulus=st.floats(1e-3, 1e3))
def test_other_lengths_and_moduli(test, length, modulus):
    # Depths go as lengths, pressures as moduli, loads as both.
    agree(ran({**test, "length": length, "modulus": modulus}), ran(test))


@few
@given(test=wear_tests(), modulus=st.floats(1e-3, 1e3))
def test_other_moduli_in_explicit_steps(test, modulus):
    agree(ran({**test, "modulus": modulus}, explicit=True), ran(test, explicit=True))
