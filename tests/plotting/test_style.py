"""Pictures must read in grey, and leave no trace in the user's session."""

from itertools import pairwise

import matplotlib
import numpy as np
import pytest

from tribo.plotting.history import BODIES, LARGEST
from tribo.plotting.style import OVER, house_style, legend_below, new_figure, save_looks


def lightness(colour):
    """Relative luminance of a colour (IEC 61966-2-1)."""
    rgb = np.asarray(matplotlib.colors.to_rgb(colour))
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    return float(np.sum(linear * [0.2126, 0.7152, 0.0722]))


@pytest.mark.parametrize("count", [1, 2, 5, 17])
def test_saves_show_on_white_and_differ_from_the_next_in_dashes_and_lightness(count):
    looks = save_looks(count)
    assert len(looks) == count
    for one, other in pairwise(looks):
        assert one["linestyle"] != other["linestyle"]
        assert lightness(one["color"]) < lightness(other["color"])
    # A contrast of 2 to 1 with the paper, (1 + 0.05) / (L + 0.05).
    assert all(lightness(look["color"]) < 0.475 for look in looks)


@pytest.mark.parametrize("pair", [(LARGEST, OVER), BODIES])
def test_lines_that_may_coincide_both_show(pair):
    below, above = pair
    assert below["linewidth"] > 2 * above["linewidth"]
    assert lightness(below["color"]) > 4 * lightness(above["color"])
    assert below.get("linestyle") != above["linestyle"]


def test_the_style_ends_with_its_context_and_ignores_the_users():
    with matplotlib.rc_context({"font.size": 30.0, "axes.facecolor": "red"}):
        with house_style():
            assert matplotlib.rcParams["font.size"] == 8.0
            assert matplotlib.rcParams["axes.facecolor"] == "white"
        assert matplotlib.rcParams["font.size"] == 30.0


def test_a_legend_reads_row_by_row_and_names_the_ends_of_many():
    with house_style():
        figure = new_figure(60.0)
        axes = figure.add_subplot()
        lines = [
            axes.plot([0, 1], [0, 1], label=str(i), **look)[0]
            for i, look in enumerate(save_looks(40))
        ]
        mark = axes.axhline(1.0, label="mark")
        legend_below(figure, lines[:4])
        legend_below(figure, lines, marks=[mark])
    few, many = ([text.get_text() for text in legend.get_texts()] for legend in figure.legends)
    # Two columns, filled from the left: 0 and 2 stand above each other.
    assert few == ["0", "2", "1", "3"]
    assert len(many) == 12
    assert {"0", "39", "mark"} <= set(many)
