"""A cycle resolved in a window that repeats: bodies that pass come in again at the other end."""

from itertools import product

import numpy as np
import pytest
from paper_models import FOUNDATION, K, archard, flat, last, motion, named, small, sphere, steel

from tribo import (
    Grid,
    Implicit,
    Measured,
    Periodic,
    Rough,
    Stop,
    Unidirectional,
    Waves,
    Winkler,
)
from tribo.simulation.march import begin
from tribo.simulation.predict import predict
from tribo.simulation.validity import tribo_findings
from tribo.stepping.first_contact import first_contact

GRID = Grid((0.32e-3, 0.32e-3), (16, 16))
(DX, DY), LOAD = GRID.spacing, 20.0


class Repeats(Winkler):
    """A foundation under surfaces that repeat."""

    type = "test.repeats"
    periodic = True


def rough(seed):
    return Rough(sq=1e-7, cut_off=0.08e-3, roll_off=0.16e-3, period=GRID.size[0], seed=seed)


def bodies(*surfaces, wears=(True, True)):
    laws = [archard() if wear else None for wear in wears]
    return [
        named(name, surface, steel(), law)
        for name, surface, law in zip(("upper", "lower"), surfaces, laws, strict=True)
    ]


def repeating(kinematics, **changes):
    parts = {
        "grid": GRID,
        "load": LOAD,
        "contact": Repeats(modulus=FOUNDATION),
        "bodies": bodies(rough(1), rough(2)),
        "kinematics": kinematics,
        "stop": Stop(distance=1.0),
        "stepping": Implicit(pressure_tolerance=0.005),
        **changes,
    }
    return small(**parts)


def strokes(cells, **values):
    return motion(stroke=cells * DX, **{"positions": "cells", **values})


def track(length):
    return Unidirectional(speed=0.1, track_length=length, distance=1.0)


SINE = {"waveform": "sinusoidal"}
PATH = [(0, 0), (1, 50 * DX), (2, 50 * DX), (5, -3.3 * DX), (6, 0)]


MOTIONS = [strokes(6), strokes(40, positions=5), strokes(40.3)]
IN_FEW_CELLS = [strokes(16), strokes(37, positions=5, **SINE)]
IN_FEW_CELLS += [Measured(path=PATH, cycles=50, positions="cells")]


@pytest.mark.parametrize(
    ("kinematics", "cells"),
    [(kinematics, GRID.cells) for kinematics in MOTIONS]
    + list(product(IN_FEW_CELLS, [(1, 1), (2, 1), (5, 3)])),
)
def test_two_flats_wear_evenly_in_windows_of_many_cells_or_few(kinematics, cells):
    grid = Grid(GRID.size, cells)
    flats = bodies(flat(), flat())
    state = last(repeating(kinematics, grid=grid, contact=Periodic(), bodies=flats))
    depth = K * LOAD / (GRID.size[0] * GRID.size[1]) * state.distance
    for body in state.bodies.values():
        np.testing.assert_allclose(body.wear, depth, rtol=1e-10)


def test_a_surface_that_ends_at_the_window_is_told_of():
    ending = rough(1).model_copy(update={"period": None})
    model = repeating(strokes(16), bodies=bodies(flat(), ending))
    (found,) = begin(model).findings
    assert (found.kind, found.place) == ("period", "bodies.lower.surface")
    assert found.value > 0
    assert tribo_findings(model) == [found]


@pytest.mark.parametrize("surface", [rough(3), sphere(), Waves(amplitude=1e-7, wavelength=8e-5)])
def test_a_surface_that_repeats_goes_without_a_word(surface):
    model = repeating(track(GRID.size[0]), bodies=bodies(surface, flat()))
    assert begin(model).findings == ()


def test_of_a_contact_without_an_end_the_average_holds_for_a_track_of_one_period():
    # Two flats wear alike; averaged over 1 m one of them has what a single window wears there.
    flats = {"bodies": bodies(flat(), flat()), "contact": Periodic()}
    model = repeating(track(1.0), **flats)
    state = last(model)
    upper, lower = (np.mean(state.bodies[name].wear) for name in ("upper", "lower"))
    (found,) = state.findings
    assert lower == pytest.approx(3.2e-4 * upper, rel=1e-9, abs=0)
    assert (found.kind, found.place) == ("averaging", "bodies.lower")
    assert found.limit / found.value == pytest.approx(3.2e-4)
    assert found.words in [problem.words for problem in predict(model).problems]
    for other in (strokes(16), track(GRID.size[0])):
        assert begin(repeating(other, **flats)).findings == ()


def test_a_check_foresees_them():
    foreseen = predict(repeating(strokes(16), contact=Periodic(), load=2000.0))
    depth = K * 2000 / (GRID.size[0] * GRID.size[1])
    assert foreseen.problems == ()
    assert [b.max_wear_depth for b in foreseen.last.bodies.values()] == pytest.approx([depth] * 2)
    assert foreseen.positions == 16


def test_waves_press_at_each_position_as_far_apart_as_they_have_come():
    waves = [Waves(amplitude=a, wavelength=GRID.size[0], along="x") for a in (2e-8, 3e-8)]
    model = repeating(
        strokes(16), contact=Periodic(tolerance=1e-12), bodies=bodies(*waves), load=2000
    )
    x = GRID.x[:, None]
    q = 2 * np.pi / GRID.size[0]
    mean = 2000 / (GRID.size[0] * GRID.size[1])
    # In full contact a wave of the amplitude A is pressed flat by E* q A / 2.
    for contact, cell in zip(first_contact(model).contacts, range(-8, 8), strict=True):
        wave = 2e-8 * np.cos(q * x) + 3e-8 * np.cos(q * (x - cell * DX))
        expected = mean + 0.5 * model.contact.system.modulus * q * wave
        assert np.min(expected) > 0
        np.testing.assert_allclose(contact.pressure, expected + 0 * GRID.y, rtol=1e-9)
