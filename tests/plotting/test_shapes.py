"""Pictures read whatever the shape of the contact: long, flat, even or rough."""

from itertools import pairwise

import numpy as np
import pytest
from made_results import TIMES, made

from tribo.core.grid import Grid
from tribo.plotting import (
    contact_history,
    groove,
    pressure_map,
    pressure_sections,
    worn_section,
)
from tribo.plotting.difference import difference_map
from tribo.plotting.overlays import profile_overlay

ENDLESS = 1e9
CASES = {
    "line contact": {"shape": (0.3, ENDLESS), "curvature": (200.0, 0.0)},
    "flat pin": {"shape": (ENDLESS, ENDLESS), "power": 1e-9, "curvature": None},
    "rough": {"texture": 0.6, "curvature": None},
    "long window": {"grid": Grid((10e-3, 1e-3), (100, 20)), "shape": (4.0, 0.4)},
    "1:1000": {"grid": Grid((1e-3, 1.0), (40, 40)), "shape": (0.3, 300.0)},
    "hard": {"cap": 2e9},
}
PICTURES = {
    "pressure_map": pressure_map,
    "pressure_sections": pressure_sections,
    "worn_section": worn_section,
    "contact_history": contact_history,
    "profile_overlay": lambda result: profile_overlay(
        {"one": result, "two": result}, "ball", result.times[-1]
    ),
}


@pytest.fixture(scope="module", params=CASES, ids=CASES)
def case(request):
    return request.param, made(**CASES[request.param])


def every_axes(figure):
    return [axes for parent in figure.axes for axes in (parent, *parent.child_axes)]


def tick_boxes(axis):
    """Where the labels of the ticks in sight stand, in order."""
    low, high = sorted(axis.get_view_interval())
    labels = zip(axis.get_majorticklocs(), axis.get_majorticklabels(), strict=False)
    return [
        label.get_window_extent()
        for place, label in labels
        if low <= place <= high and label.get_visible() and label.get_text()
    ]


def half_width(result, axis, save=-1):
    """Largest distance of a cell's edge in contact from the centre, in mm."""
    pressure = result.pressure(save % len(result.times))
    index = np.flatnonzero((pressure > 0).any(axis=1 - axis))
    x = (result.grid.x, result.grid.y)[axis][index]
    return 1e3 * (np.max(np.abs(x)) + 0.5 * result.grid.spacing[axis])


def shown_mm(axis):
    """Largest distance from the centre that an axis shows, in mm."""
    unit = axis.get_label_text().split("(")[1].split(")")[0]
    return np.max(np.abs(axis.get_view_interval())) * {"mm": 1.0, "µm": 1e-3}[unit]


@pytest.mark.parametrize("draw", PICTURES.values(), ids=PICTURES)
def test_nothing_is_cut_off_and_no_tick_labels_overlap(case, draw):
    figure = draw(case[1])
    figure.draw_without_rendering()
    text, paper = figure.get_tightbbox(), figure.bbox_inches
    assert min(text.x0, text.y0, paper.x1 - text.x1, paper.y1 - text.y1) > -0.01
    for axes in every_axes(figure):
        for axis in (axes.xaxis, axes.yaxis):
            boxes = tick_boxes(axis)
            assert not any(a.overlaps(b) for a, b in pairwise(boxes))


def test_a_map_shows_the_contact_and_little_else(case):
    result = case[1]
    (axes,) = pressure_map(result).axes
    axes.figure.draw_without_rendering()
    for number, axis in enumerate((axes.xaxis, axes.yaxis)):
        reach = half_width(result, number)
        assert 0.99 * reach <= shown_mm(axis) <= 1.5 * reach


@pytest.mark.parametrize("draw", [worn_section, pressure_sections])
def test_sections_show_the_contact_and_little_else(case, draw):
    result = case[1]
    figure = draw(result)
    figure.draw_without_rendering()
    for number, axes in enumerate(figure.axes[-2:]):
        reach = max(half_width(result, number, save) for save in range(len(result.times)))
        # The outermost cells' centres end a section.
        outside = result.grid.spacing[number] * 1e3
        assert reach - outside <= shown_mm(axes.xaxis) <= 1.5 * reach


def test_the_scales_of_a_map_are_equal_or_the_axis_says_how_unequal(case):
    (axes,) = pressure_map(case[1]).axes
    axes.figure.draw_without_rendering()
    box = axes.get_window_extent()
    x, y = box.width / shown_mm(axes.xaxis), box.height / shown_mm(axes.yaxis)
    for axis, enlarged in ((axes.xaxis, x / y), (axes.yaxis, y / x)):
        label = axis.get_label_text()
        if enlarged > 1.05:
            assert float(label.split("enlarged ")[1].split()[0]) == pytest.approx(enlarged, rel=0.1)
        else:
            assert "enlarged" not in label


def test_the_colours_of_a_map_start_at_zero(case):
    (axes,) = pressure_map(case[1]).axes
    (bar,) = axes.child_axes
    assert axes.images[0].get_clim()[0] == bar.get_ylim()[0] == 0.0


def test_an_even_pressure_is_stated():
    result = made(**CASES["flat pin"])
    (axes,) = pressure_map(result).axes
    mean = 100.0 / (2e-3 * 1.6e-3) * 1e-6
    assert f"{mean:.3g} MPa, even within 1 %" in axes.get_title(loc="left")


def contours(axes):
    """Pieces of the thin lines of a map, the thick edge of the contact left out."""
    sets = [c for c in axes.collections if hasattr(c, "allsegs") and c.get_linewidths()[0] < 0.6]
    return [piece for lines in sets for pieces in lines.allsegs for piece in pieces if len(piece)]


def test_lines_of_equal_pressure_are_closed_or_end_at_a_label_or_the_window(case):
    result = case[1]
    (axes,) = pressure_map(result).axes
    axes.figure.draw_without_rendering()
    labels = [text.get_window_extent().padded(10) for text in axes.texts]
    window = np.array([[x[0], x[-1]] for x in (result.grid.x, result.grid.y)]).T
    for piece in contours(axes):
        if np.allclose(piece[0], piece[-1], atol=1e-9):
            continue
        for end in piece[[0, -1]]:
            at_edge = np.any(np.isclose(1e-3 * end, window, atol=1e-9))
            assert at_edge or any(box.contains(*axes.transData.transform(end)) for box in labels)


def test_a_smooth_pressure_keeps_its_lines():
    (axes,) = pressure_map(made()).axes
    assert contours(axes)
    assert axes.texts


def test_labels_on_a_map_stand_apart(case):
    (axes,) = pressure_map(case[1], 1).axes
    axes.figure.draw_without_rendering()
    boxes = [text.get_window_extent() for text in axes.texts]
    assert not any(a.overlaps(b) for i, a in enumerate(boxes) for b in boxes[:i])


@pytest.mark.parametrize("worn", [(True, True), (True, False), (False, True)])
def test_the_unworn_profile_of_each_worn_body_is_drawn_in_sight(worn):
    result = made(worn=worn)
    figure = worn_section(result)
    figure.draw_without_rendering()
    named = {text.get_text() for text in figure.legends[0].get_texts()} - {"worn"}
    expected = [name for name, wears in zip(("ball", "disk"), worn, strict=True) if wears]
    assert named == {f"{name} unworn" for name in expected}
    for axis, axes in enumerate(figure.axes):
        lines = {line.get_label(): line.get_xydata().T for line in axes.lines}
        (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
        for label in named:
            x, z = lines[label]
            z = z[(x >= left) & (x <= right)]
            assert np.all((z > low) & (z < high))
            height = 1e6 * result.body(label.split()[0]).height
            ny = height.shape[1 - axis] // 2
            middle = np.take(height, ny, axis=1 - axis)
            assert np.ptp(lines[label][1]) == pytest.approx(np.ptp(middle), rel=0.01, abs=1e-12)


def test_a_picometre_is_not_a_thousandth_of_a_nanometre():
    (axes,) = groove(made((0.0, 1e-2)), "disk").axes
    axes.figure.draw_without_rendering()
    assert axes.get_ylabel() == "Height (pm)"
    assert not axes.yaxis.get_offset_text().get_text()


def test_half_widths_of_a_long_contact_both_show():
    result = made(**CASES["1:1000"])
    _, lower = contact_history(result).axes
    for line in lower.lines:
        y = lower.transAxes.inverted().transform(lower.transData.transform(line.get_xydata()))[:, 1]
        assert np.all((y > 0.02) & (y < 0.98))


@pytest.mark.parametrize("name", ["line contact", "1:1000"])
def test_maps_of_differences_fit_the_contact(name):
    one, two = made(**CASES[name]), made(**CASES[name], power=1.0)
    figure = difference_map({"one": one, "two": two}, "two", TIMES[-1])
    figure.draw_without_rendering()
    for number in (0, 1):
        axis = (figure.axes[0].xaxis, figure.axes[0].yaxis)[number]
        reach = half_width(one, number)
        assert 0.99 * reach <= shown_mm(axis) <= 1.5 * reach
