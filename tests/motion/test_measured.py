"""A motion as it was measured: what is slid, where, and how fast."""

import numpy as np
import pytest
from paper_models import case, foundation, last, small

from tribo import CaseError, Effect, Field, Grid, Measured
from tribo.config.load import validate_case
from tribo.core.grid import RepeatingGrid

PATH = [(1, 0.0), (2, 0.0), (3, 4e-4), (5, 4e-4), (6, 2e-4), (8, 8e-4), (9, 0.0), (12, 0.0)]
"""It rests thrice and turns round thrice: 2 mm in 11 s."""


def test_the_sliding_distance_is_the_total_variation():
    measured = Measured(path=PATH)
    assert measured.end_time == 11
    assert measured.distance_at(11) == pytest.approx(2e-3)
    np.testing.assert_allclose(
        [measured.distance_at(t) for t in (0.5, 1.5, 3, 4, 5, 6, 7.5, 10)],
        [0, 2e-4, 4e-4, 4e-4, 6e-4, 9e-4, 1.6e-3, 2e-3],
        atol=1e-18,
    )


def test_a_distance_is_reached_before_the_rest_that_follows():
    measured = Measured(path=PATH, cycles=3)
    assert measured.time_at(0) == 0
    for distance, time in ((2e-4, 1.5), (4e-4, 2), (2e-3, 8), (2.4e-3, 13), (6e-3, 30)):
        assert measured.time_at(distance) == pytest.approx(time), distance
    assert measured.end_time == 33


@pytest.mark.parametrize("cycles", [1, 3, 7, 49, 1000])
def test_a_whole_pass_ends_before_the_rest_with_which_the_next_begins(cycles):
    path = [(0, 0), (1, 0), (2, 1e-3), (3, 0)]
    measured = Measured(path=path, cycles=cycles)
    for distance in (2e-3 * cycles, 2e-3 * cycles * (1 + 4e-16)):
        assert measured.time_at(distance) == pytest.approx(3 * cycles)


@pytest.mark.parametrize(
    ("grid", "expected"),
    [
        (Grid(1e-3, 50), {0: 4, 20: 2}),
        # The first end is 5 cells beside the middle, one period of 25 cells further on.
        (RepeatingGrid(size=5e-4, cells=25), {12: 2, 17: 4}),
    ],
)
def test_rests_fall_to_the_places_where_they_are(grid, expected):
    measured = Measured(path=PATH, positions="cells")
    cycle = measured.cycle(grid)
    rests = np.array([2e-3 * position.share * position.rest for position in cycle])
    assert {i: pytest.approx(t) for i, t in enumerate(rests) if t > 1e-9} == expected
    slid = sum(2e-3 * p.share * sum(part / v for v, part in p.speeds) for p in cycle)
    assert slid + np.sum(rests) == pytest.approx(measured.end_time)


class Warms(Effect):
    """dT/dt = 1000 K/m v - T/10 s."""

    type = "test.warms"
    state_fields = (Field("warmth", "K", "Temperature of a bath.", uniform=True, at_least=0),)

    def state_rates(self, contact):
        return {"warmth": 1000 * contact.speed - contact.state["warmth"] / 10}


def test_what_relaxes_in_time_goes_on_in_rests():
    cells = 4 * GRID.spacing[0]
    # It slides for a tenth of the time; the first and the last save are in a rest.
    path = [(0, 0), (0.9, 0), (0.95, cells), (1, 0)]
    model = small(
        grid=GRID,
        contact=foundation(),
        effects=[Warms()],
        save_times=(0.5, 10.5, 20.7, 39.3),
        kinematics=Measured(positions="cells", path=path, cycles=40),
    )
    speed = 2 * cells
    assert last(model).between["warmth"][0, 0] == pytest.approx(
        10 * 1000 * speed * (1 - np.exp(-4)), rel=1e-4
    )


@pytest.mark.parametrize("name", ["path.csv", "path.npy"])
def test_a_path_may_lie_in_a_file(tmp_path, name):
    file = tmp_path / name
    if name.endswith("npy"):
        np.save(file, PATH)
    else:
        np.savetxt(file, PATH, delimiter=",", header="time [s],position [m]", comments="")
    assert Measured(path=file) == Measured(path=str(file)) == Measured(path=PATH)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"path": "nowhere.csv"}, "no file nowhere.csv"),
        ({"path": [[0, 0]]}, "at least 2"),
        ({"path": [[0, 0], [0, 1e-3]]}, "time must increase.* 0 s is followed by 0 s"),
        ({"path": [[0, 1e-3], [1, 1e-3]]}, "never changes"),
        ({"path": [[0, 0], [1, 1e-3]], "cycles": 2}, "must end where it begins"),
        ({"cycles": 2, "duration": 5}, "duration or cycles, not both"),
        ({"positions": 8}, "8 is even"),
    ],
)
def test_a_path_that_is_none_is_refused(changes, words):
    kinematics = {"type": "measured", "path": PATH, **changes}
    with pytest.raises(CaseError, match=f"kinematics.*{words}"):
        validate_case(case().model_dump() | {"kinematics": kinematics})


GRID = Grid((1.2e-3, 0.75e-3), (32, 20))
