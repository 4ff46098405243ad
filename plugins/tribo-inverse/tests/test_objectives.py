"""Objectives of a gradient: their values and slopes, and those that are refused."""

from types import SimpleNamespace

import numpy as np
import pytest
from gradients import run
from tribo.case import Stop
from tribo.core.errors import CaseError
from tribo.core.grid import Grid

from tribo_inverse.adjoint.gradient import gradient
from tribo_inverse.adjoint.objective import (
    Deepest,
    Depth,
    EndDistance,
    EndTime,
    Misfit,
    Pressure,
    Volume,
    Width,
)
from tribo_inverse.adjoint.view import Seeds

NAN, INF = np.nan, np.inf


@pytest.mark.parametrize("given", ["volume", Volume, {}])
def test_what_is_no_objective_is_refused(given):
    with pytest.raises(CaseError, match=r"(?i)(volume|none).* is no objective; give a Volume"):
        gradient(run(), given)


@pytest.mark.parametrize("time", ["20 s", None, True, NAN])
def test_a_time_to_look_at_that_is_none_is_refused(time):
    with pytest.raises(CaseError, match=f"has the time {time!r}, which is no number"):
        gradient(run(), {time: Volume("ball")})


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Deepest("ball", 1), "an order of 1 of Deepest is not allowed"),
        (lambda: Depth("ball", "1 mm"), r"the place is x = '1 mm', y = 0\.0; give numbers, in m"),
        (lambda: Pressure(0.0, None), r"the place is x = 0\.0, y = None"),
        (lambda: Misfit("ball", [[1.0], [1.0, 2.0]]), "depth of ball is no array of numbers"),
        (lambda: Width("ball", 5), "the axis of Width is 5; give 0 for along, or 1"),
        (lambda: Misfit("ball", np.zeros((3, 3)), 0.0), "the uncertainty of Misfit is 0.0"),
        (lambda: Misfit("ball", np.diag([INF, 1, 1])), "is infinite somewhere"),
    ],
)
def test_an_objective_that_means_nothing_is_refused(make, message):
    with pytest.raises(CaseError, match=message):
        make()


@pytest.mark.parametrize(
    ("answer", "message"),
    [
        (3.0, "mine gave 3.0; an objective gives its value and Seeds"),
        ((1.0, Seeds(np.ones((3, 3)))), "its value and Seeds, whose wear is by body"),
        ((NAN, Seeds()), "the value of mine is NaN, infinite or no number"),
        ((np.ones(2), Seeds()), r"the value of mine has the shape \(2,\), not \(\)"),
        ((1.0, Seeds(time=INF)), "the seed by time of mine is NaN, infinite"),
        ((1.0, Seeds(pressure=np.ones((3, 3)))), r"pressure of mine has the shape \(3, 3\), not"),
        ((1.0, Seeds({"ring": np.ones((3, 3))})), "there is no body 'ring'"),
        ((1.0, Seeds({"ball": [[1.0], [1.0, 2.0]]})), "wear of ball of mine is NaN, infinite or"),
        ((1.0, Seeds({"ball": np.ones((3, 3))})), r"wear of ball of mine has the shape \(3, 3\)"),
    ],
)
def test_an_objective_that_gives_no_value_and_seeds_is_refused(answer, message):
    def mine(view):
        return answer

    with pytest.raises(CaseError, match=message):
        gradient(run(), mine, [])


@pytest.mark.parametrize("cells", [(40, 31), (1, 40)])
def test_the_width_is_that_of_a_ball_worn_flat_and_has_its_derivative(cells):
    grid, half = Grid(size=("1 mm", "1 mm"), cells=(40, cells[1])), 0.3e-3
    x, y = np.zeros((1, 1)) if cells[0] == 1 else grid.mesh[0], grid.mesh[1]
    worn = np.maximum(1e-6 * (1 - (x**2 + (y - 1e-5) ** 2) / half**2), 0.0)

    def width(depth):
        return Width("ball")(SimpleNamespace(wear=lambda body: depth, grid=grid))

    value, seeds = width(worn)
    assert value == pytest.approx(2 * half, rel=5e-3)
    change = 1e-9 * np.random.default_rng(0).standard_normal(worn.shape)
    difference = 0.5 * (width(worn + change)[0] - width(worn - change)[0])
    assert np.sum(seeds.wear["ball"] * change) == pytest.approx(difference, rel=1e-4)
    for nothing in (0 * worn, worn * (np.arange(worn.size).reshape(worn.shape) == worn.size // 2)):
        value, seeds = width(nothing)
        assert value == 0 == np.max(np.abs(seeds.wear["ball"]))


def test_a_save_that_is_not_there_is_refused():
    with pytest.raises(CaseError, match="nothing is saved at 3 s"):
        gradient(run(), {3.0: Volume("ball")}, [])


def test_a_depth_that_ends_the_run_before_an_objective_looks_is_refused():
    stops = run(stop=Stop(depth="0.2 um"), save_times=(15.0,))
    with pytest.raises(CaseError, match=r"a depth ends the run at 6\.\d+ s, before the time 15 s"):
        gradient(stops, {15.0: Volume("ball")}, [])


@pytest.mark.parametrize(
    ("stop", "message"),
    [
        (Stop(), "stop.depth: is not given"),
        (Stop(depth="1 um"), r"after 20 s .* is 0\.5\d+ µm of 1 µm"),
        (Stop(depth="0.2 um", body="disk"), r" is 0\.04\d+ µm of 0\.2 µm"),
    ],
)
@pytest.mark.parametrize("lasts", [EndTime(), EndDistance()])
def test_what_a_body_lasts_is_refused_where_no_depth_ends_the_run(stop, message, lasts):
    with pytest.raises(CaseError, match=message):
        gradient(run(stop=stop), lasts, [])
