"""Pictures read whatever the shape of the contact: long, flat, even or rough."""

import numpy as np
import pytest
from made_results import SHAPES, half_width, made

from tribo.core.grid import Grid
from tribo.plotting.pressure import pressure_map, pressure_sections
from tribo.plotting.profiles import body_profiles, scar_map, worn_section
from tribo.result.export import profile


@pytest.fixture(scope="module", params=["rough", "long window", "1:1000"])
def case(request):
    return made(**SHAPES[request.param])


def edge_of_contact(result, axis, save=-1):
    """Largest distance of a cell's edge in contact from the centre, in mm."""
    pressure = result.field("pressure", save % len(result.times))
    index = np.flatnonzero((pressure > 0).any(axis=1 - axis))
    x = (result.grid.x, result.grid.y)[axis][index]
    return 1e3 * (np.max(np.abs(x)) + 0.5 * result.grid.spacing[axis])


def shown_mm(axis):
    """Largest distance from the centre that an axis shows, in mm."""
    unit = axis.get_label_text().split("(")[1].split(")")[0]
    return np.max(np.abs(axis.get_view_interval())) * {"mm": 1.0, "µm": 1e-3}[unit]


@pytest.mark.parametrize("draw", [pressure_map, worn_section, pressure_sections])
def test_a_picture_shows_the_contact_and_little_else(case, draw):
    figure = draw(case).figure()
    figure.draw_without_rendering()
    is_map = draw is pressure_map
    # A map has both axes, and of sections the last two panels go along and across.
    shown = (figure.axes[0].xaxis, figure.axes[0].yaxis)
    if not is_map:
        shown = [axes.xaxis for axes in figure.axes[-2:]]
    saves = [-1] if is_map else range(len(case.times))
    for number, axis in enumerate(shown):
        reach = max(edge_of_contact(case, number, save) for save in saves)
        # The outermost cells' centres end a section.
        missing = 0.01 * reach if is_map else case.grid.spacing[number] * 1e3
        assert reach - missing <= shown_mm(axis) <= 1.5 * reach


@pytest.mark.parametrize("worn", [(True, True), (True, False), (False, True)])
def test_the_unworn_profile_of_each_worn_body_is_drawn_in_sight(worn):
    figure = worn_section(made(worn=worn)).figure()
    named = {text.get_text() for text in figure.legends[0].get_texts()}
    bodies = zip(("ball", "disk"), worn, strict=True)
    assert named == {"worn"} | {f"{name} unworn" for name, wears in bodies if wears}
    for axes in figure.axes:
        low, high = axes.get_ylim()
        for line in axes.lines:
            x, z = line.get_data()
            z = z[np.abs(x) < 1e3 * half_width(3600.0)]
            assert np.all((z > low) & (z < high))


def test_what_varies_along_one_axis_only_is_drawn_along_it():
    result = made(**SHAPES["line contact"])
    for drawn, factor, field in (
        (pressure_map(result), 1e-6, result.field("pressure", -1)),
        (scar_map(result, "ball"), 1e6, result.body("ball").wear_depth[-1]),
    ):
        (axes,) = drawn.figure().axes
        (line,) = axes.lines
        np.testing.assert_allclose(line.get_ydata()[1:-1], factor * profile(field, 0))
        assert axes.get_xlabel() == "Along sliding, x (mm)"
    for draw in (pressure_sections(result), body_profiles(result, "ball"), worn_section(result)):
        assert {len(row) for row in draw.rows} == {1}


def test_the_end_peaks_of_a_line_that_ends_at_the_window_are_seen_to_end_there():
    grid = Grid((2e-3, 1.6e-3), (50, 40), ends_at_window=True)
    result = made((0.0,), **SHAPES["line contact"], grid=grid)
    peaks = np.array(result.field("pressure", 0))
    peaks[:, [0, -1]] *= 1.5
    result.field = lambda name, save, body=None: peaks
    *_, across = pressure_sections(result).figure().axes
    x, p = across.lines[0].get_data()
    assert (x[0], x[-1]) == pytest.approx((-0.8, 0.8))
    low, high = across.get_xlim()
    assert low < x[0]
    assert x[-1] < high
    assert p.max() == pytest.approx(1e-6 * profile(peaks, 1).max())
    assert across.get_ylim()[1] > p.max()
