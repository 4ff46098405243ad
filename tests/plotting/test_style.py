"""Pictures must read in grey, and leave no trace in the user's session."""

import subprocess
import sys
from itertools import pairwise

import matplotlib
import numpy as np
import pytest

from tribo.plotting.history import ACROSS, ALONG, CENTRE, LARGEST
from tribo.plotting.section import UNWORN, WORN
from tribo.plotting.style import (
    BODY_STROKES,
    house_style,
    legend_below,
    new_figure,
    pressure_colours,
    save_strokes,
)


def lightness(colour):
    """Relative luminance of a colour (IEC 61966-2-1)."""
    rgb = np.asarray(matplotlib.colors.to_rgb(colour))
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    return float(linear @ [0.2126, 0.7152, 0.0722])


def test_higher_pressure_is_lighter_and_no_contact_white():
    colours = pressure_colours()
    shades = [lightness(colours(value)[:3]) for value in np.linspace(0, 1, 64)]
    assert np.all(np.diff(shades) > 0)
    assert lightness(colours.get_bad()[:3]) > shades[-1] + 0.1


@pytest.mark.parametrize("count", [1, 2, 5, 17])
def test_saves_following_each_other_differ_in_dashes_and_lightness(count):
    strokes = save_strokes(count)
    assert len(strokes) == count
    for one, other in pairwise(strokes):
        assert one.dashes != other.dashes
        assert lightness(one.colour) < lightness(other.colour)


def test_every_save_shows_on_white():
    # A contrast of 2 to 1 with the paper, (1 + 0.05) / (L + 0.05).
    assert all(lightness(stroke.colour) < 0.475 for stroke in save_strokes(9))


def test_bodies_differ_in_marker_width_and_lightness():
    one, other = BODY_STROKES
    assert one.marker != other.marker
    assert one.width > 2 * other.width
    assert lightness(one.colour) > 4 * lightness(other.colour)


@pytest.mark.parametrize(
    "pair", [(LARGEST, CENTRE), (ALONG, ACROSS), (WORN, UNWORN[0]), (WORN, UNWORN[1]), UNWORN]
)
def test_other_pairs_of_lines_differ_in_dashes(pair):
    one, other = pair
    assert one.dashes != other.dashes


@pytest.mark.parametrize("pair", [(LARGEST, CENTRE), (ALONG, ACROSS)])
def test_lines_that_may_coincide_both_show(pair):
    below, above = pair
    assert below.width > 2 * above.width
    assert lightness(below.colour) > 4 * lightness(above.colour)


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
        x = np.arange(2.0)
        lines = [s.draw(axes, x, x, str(i)) for i, s in enumerate(save_strokes(40))]
        legend_below(figure, lines[:4])
        legend_below(figure, lines)
    few, many = ([text.get_text() for text in legend.get_texts()] for legend in figure.legends)
    # Two columns, filled from the left: 0 and 2 stand above each other.
    assert few == ["0", "2", "1", "3"]
    assert len(many) == 12
    assert {"0", "39"} <= set(many)


def test_drawing_needs_no_pyplot():
    code = "import sys, tribo.plotting; sys.exit('matplotlib.pyplot' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
