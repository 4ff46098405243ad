"""Pictures must read in grey, and leave no trace in the user's session."""

from itertools import pairwise

import matplotlib
import numpy as np
import pytest

from tribo.plotting.style import house_style, save_looks


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


def test_the_style_ends_with_its_context_and_ignores_the_users():
    with matplotlib.rc_context({"font.size": 30.0, "axes.facecolor": "red"}):
        with house_style():
            assert matplotlib.rcParams["font.size"] == 8.0
            assert matplotlib.rcParams["axes.facecolor"] == "white"
        assert matplotlib.rcParams["font.size"] == 30.0
