"""Pictures and tables of a result on one's own axes, in one's own style."""

import matplotlib
import numpy as np
import pytest
from made_results import TIMES, made
from matplotlib import pyplot
from PIL import Image

from tribo.cli.animation import save_animation
from tribo.core.errors import CaseError


@pytest.fixture(scope="module")
def result():
    return made()


@pytest.fixture(autouse=True)
def closed():
    yield
    pyplot.close("all")


def test_a_picture_is_drawn_on_the_axes_that_are_given(result):
    _, (left, right) = pyplot.subplots(1, 2)
    assert result.plot.scar("ball", time=200, ax=left) is left
    assert left.get_title(loc="left") == "ball, t = 200 s"
    depth = 1e6 * result.body("ball").wear_depth[1]
    assert np.max(left.images[0].get_array()) == pytest.approx(depth.max())
    result.plot.profiles("ball", axis=1, ax=right)
    assert [line.get_label() for line in right.lines][-1] == "3600 s"
    with pytest.raises(CaseError, match=r"4 panels, 1 axes.*subplots\(2, 2\)"):
        result.plot.sections(ax=right)


def test_axes_of_ones_own_have_the_style_that_is_set(result):
    with matplotlib.rc_context({"axes.labelsize": 17.0}):
        (first, _), _ = result.plot.sections()
    assert first.xaxis.label.get_fontsize() == 17.0
    assert pyplot.get_fignums() == [first.figure.number]


def test_every_kind_that_dir_names_draws(result):
    for name in dir(result.plot):
        of = {"scar": ["ball"], "profiles": ["disk"], "history": ["wear"]}.get(name, [])
        assert np.ravel(getattr(result.plot, name)(*of))[0].figure.axes
    assert "height_map" not in dir(result.plot)


@pytest.mark.parametrize(
    ("draw", "there"),
    [
        (lambda plot: plot.scar("bal"), "ball, disk"),
        (lambda plot: plot.scar(), "ball, disk"),
        (lambda plot: plot.history("contacts"), "wear, contact"),
        (lambda plot: plot.pressure(time=7), "0, 200, 500, 1500, 3600"),
        (lambda plot: plot.profiles("ball", saves=(1, 9)), "it takes time, ax, axis"),
        (lambda plot: plot.pressure(axis=0), "time, ax"),
        (lambda plot: plot.history("wear", time=200), "leave time out"),
    ],
)
def test_what_is_not_there_is_answered_with_what_is(draw, there, result):
    with pytest.raises(CaseError, match=there):
        draw(result.plot)
    with pytest.raises(AttributeError, match="There are history, pressure, prof"):
        result.plot.scars  # noqa: B018


def test_a_picture_of_curves_takes_several_times_and_a_map_takes_one(result):
    axes = result.plot.profiles("ball", time=[200, "1 h"], axis=0)
    assert [line.get_label() for line in axes.lines] == ["200 s", "3600 s"]
    with pytest.raises(CaseError, match=r"plot\.scar.*a list"):
        result.plot.scar("ball", time=[200, 3600])
    with pytest.raises(CaseError, match=r"plot\.scar.*a length"):
        result.plot.scar("ball", time="2 mm")


@pytest.mark.slow
def test_an_animation_has_a_frame_for_each_saved_time(result, tmp_path):
    with Image.open(save_animation(result, tmp_path / "new" / "run.gif")) as image:
        assert image.n_frames == len(TIMES)
