"""Overlays show what each result holds, under its label."""

import numpy as np
import pytest
from made_results import GRID, made
from matplotlib import pyplot

from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.plotting.overlays import comparison_picture
from tribo.result.export import profile
from tribo.study.comparison import Comparison


@pytest.fixture(scope="module")
def results():
    return {"one": made(), "two": made(power=1.0), "three": made(shape=(1.2, 1.1))}


def names(figure):
    return [text.get_text() for text in figure.legends[0].get_texts()]


def test_a_comparison_is_one_figure_of_all_that_is_worn(results):
    figure = comparison_picture(results, 3600.0)
    assert names(figure) == ["one", "two", "three"]
    words = [axes.get_ylabel() for axes in figure.axes[::2]]
    assert words == ["Pressure (MPa)", "Height of ball (µm)", "Height of disk (µm)"]
    for axis, axes in enumerate(figure.axes[:2]):
        for line, result in zip(axes.lines, results.values(), strict=True):
            x, p = line.get_xydata().T[:, 1:-1]
            np.testing.assert_allclose(x, 1e3 * (GRID.x, GRID.y)[axis])
            np.testing.assert_allclose(p, 1e-6 * profile(result.field("pressure", -1), axis))
    for place, axes in enumerate(figure.axes[2:]):
        body, axis = ("ball", "disk")[place // 2], place % 2
        for line, result in zip(axes.lines, results.values(), strict=True):
            expected = 1e6 * profile(result.body(body).surface(-1), axis)
            np.testing.assert_allclose(line.get_ydata()[1:-1], expected, atol=1e-12)
            assert axes.get_xlim() == figure.axes[axis].get_xlim()


def test_a_time_without_a_save_is_refused_and_different_grids_are_named(results):
    coarse = made(grid=Grid((2e-3, 1.6e-3), (25, 20)))
    figure = comparison_picture({"one": results["one"], "coarse": coarse}, 200.0)
    assert "50 × 40, 25 × 20 cells" in figure.axes[0].get_title("left")
    with pytest.raises(CaseError, match="7 s; saved times: 0, 200"):
        comparison_picture(results, 7.0)


def test_a_comparison_is_drawn_on_the_axes_that_are_given(results):
    figure, axes = pyplot.subplots(1, 2)
    assert Comparison(results).picture(200, parts=["ball"], ax=axes) is figure
    assert [line.get_label() for line in axes[0].lines] == list(results)
    with pytest.raises(CaseError, match=r"6 panels, 2 axes.*subplots\(3, 2\)"):
        Comparison(results).picture(200, ax=axes)
    pyplot.close(figure)
