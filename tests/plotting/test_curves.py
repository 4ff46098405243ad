"""Curves hold the columns that are asked for, in units that fit."""

import numpy as np
import pandas as pd
from made_results import made

from tribo.lab.kept import kept_fields
from tribo.plotting.curves import sweep_curves
from tribo.plotting.profiles import field_map
from tribo.study.sweeping.summary import sweep_pictures


def test_runs_of_a_sweep_are_curves_in_the_order_of_what_varies():
    runs = pd.DataFrame(
        {
            "status": ["done", "done", "failed", "done", "done"],
            "load_N": [40.0, 20.0, 30.0, 20.0, 40.0],
            "contact.type": ["dcfft", "dcfft", "dcfft", "winkler", "winkler"],
            "max_pressure_Pa": [4e8, 3e8, np.nan, 2e8, 5e8],
        }
    )
    figure = sweep_curves(runs, "load_N", "max_pressure_Pa", ["contact.type"])
    first, second = figure.axes[0].lines
    np.testing.assert_allclose(first.get_xydata(), [[20, 300], [40, 400]])
    np.testing.assert_allclose(second.get_xydata(), [[20, 200], [40, 500]])
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["dcfft", "winkler"]
    assert figure.legends[0].get_title().get_text() == "contact type"
    radii = runs.assign(**{"bodies.ball.surface.radius_m": [5e-3, 5e-3, 5e-3, 1e-2, 1e-2]})
    figure = sweep_curves(radii, "load_N", "max_pressure_Pa", ["bodies.ball.surface.radius_m"])
    assert figure.legends[0].get_title().get_text() == "radius of ball (mm)"
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["5", "10"]


def test_the_number_that_varies_most_is_the_axis_and_the_rest_makes_curves():
    runs = pd.DataFrame({"status": "done", "load_N": [20.0, 40.0] * 3, "k": [1, 1, 2, 2, 3, 3]})
    (draw,) = sweep_pictures(runs, ["load_N", "k"], ["k"]).values()
    (axes,) = draw().axes
    assert axes.get_xlabel() == "k"
    assert len(axes.lines) == 2
    for line in axes.lines:
        np.testing.assert_allclose(line.get_xdata(), [1, 2, 3])


def test_a_field_of_the_models_is_drawn_from_above():
    result = made(film=1e-11)
    film, share = kept_fields(result)
    assert (film.name, film.key, share.name) == ("film", "film", "load share")
    (axes,) = field_map(result, "film").figure().axes
    shown = np.nan_to_num(np.ma.filled(axes.images[0].get_array(), 0.0)).T
    np.testing.assert_allclose(shown, 1e9 * result.field("film", -1))
    assert axes.child_axes[0].get_ylabel().startswith("Film (nm)\n")
