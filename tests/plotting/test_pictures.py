"""What the pictures show is what the result holds."""

import numpy as np
import pytest
from made_results import GRID, TIMES, half_width, made

from tribo.lab.against_hertz import hertz_contact
from tribo.plotting import (
    body_profiles,
    contact_history,
    pressure_map,
    pressure_sections,
    wear_history,
    worn_section,
)
from tribo.result.export import profile


@pytest.fixture(scope="module")
def result():
    return made()


def curves(axes):
    """Curves by label, x and y."""
    return {line.get_label(): line.get_xydata().T for line in axes.lines}


def names(legend):
    return {text.get_text() for text in legend.get_texts()}


@pytest.mark.parametrize("axis", [0, 1])
def test_profiles_are_those_of_the_result_at_every_save(axis, result):
    (axes,) = body_profiles(result, "ball", axis).axes
    shown = curves(axes)
    assert list(shown) == ["0 s", "200 s", "500 s", "1500 s", "3600 s"]
    ball = result.body("ball")
    for save, (x, y) in enumerate(shown.values()):
        np.testing.assert_allclose(x, 1e3 * (GRID.x, GRID.y)[axis])
        np.testing.assert_allclose(y, 1e6 * profile(ball.surface(save), axis), atol=1e-12)
    assert np.all(shown["0 s"][1] >= shown["3600 s"][1])


def test_the_stated_enlargement_is_that_on_paper(result):
    figure = body_profiles(result, "ball", 1)
    figure.draw_without_rendering()
    (axes,) = figure.axes
    box = axes.get_window_extent()
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    per_mm, per_um = box.width / (right - left), box.height / (high - low)
    stated = float(axes.get_title(loc="right").removeprefix("height × "))
    assert stated == pytest.approx(1e3 * per_um / per_mm, rel=0.05)


def test_a_groove_is_the_swept_bodys_section(result):
    (axes,) = body_profiles(result, "disk").axes
    worn = result.body("disk").wear_depth
    for save, (_, y) in enumerate(curves(axes).values()):
        factor = 1e6 if worn.max() >= 1e-6 else 1e9
        np.testing.assert_allclose(y, -factor * worn[save, 0], atol=1e-12)


def test_sections_hold_every_save_and_hertz(result):
    figure = pressure_sections(result)
    assert len(figure.axes) == 3
    hertz = hertz_contact(result.system)
    for axis, axes in enumerate(figure.axes[1:]):
        shown = curves(axes)
        assert len(shown) == len(TIMES) + 1
        for save, label in enumerate(list(shown)[:-1]):
            expected = 1e-6 * profile(result.field("pressure", save), axis)
            np.testing.assert_allclose(shown[label][1], expected)
        x, y = shown["Hertz, 0 s"]
        assert y.max() == pytest.approx(1e-6 * hertz.peak_pressure, rel=1e-3)
        assert x[y > 0].max() == pytest.approx(1e3 * hertz.half_width_x, rel=0.02)
    assert names(figure.legends[0]) == set(curves(figure.axes[1]))


def test_a_first_pressure_that_dwarfs_the_later_ones_stands_whole_in_its_own_panel(result):
    whole, along, across = pressure_sections(result).axes
    shown = curves(whole)
    assert set(shown) == {"0 s", "Hertz, 0 s"}
    np.testing.assert_allclose(shown["0 s"][1], 1e-6 * profile(result.field("pressure", 0), 0))
    later = 1e-6 * profile(result.field("pressure", 1), 0).max()
    for axes in (along, across):
        assert later < axes.get_ylim()[1] < 1.2 * later
    others = pressure_sections(made((0.0, 1.0))).axes
    highest = 1e-6 * result.field("pressure", 0).max()
    assert all(axes.get_ylim()[1] >= highest for axes in (whole, *others))
    assert len(others) == 2


@pytest.mark.parametrize("times", [(0.0, 1.0), TIMES])
def test_sections_that_reach_the_hardness_mark_it(times):
    figure = pressure_sections(made(times, cap=2e9))
    first = figure.axes[0]
    assert "hardness" in names(figure.legends[0])
    np.testing.assert_allclose(curves(first)["hardness"][1], 2e3)
    assert first.get_ylim()[1] > 2e3


def test_the_map_is_the_pressure_from_zero_to_the_largest(result):
    (axes,) = pressure_map(result, 1).axes
    (image,) = axes.images
    pressure = 1e-6 * result.field("pressure", 1).T
    shown = np.asarray(image.get_array())
    np.testing.assert_allclose(shown, np.where(pressure > 0, pressure, np.nan))
    np.testing.assert_allclose(image.get_extent(), [-1.0, 1.0, -0.8, 0.8])
    assert image.get_clim() == (0.0, pytest.approx(pressure.max()))
    assert axes.get_title(loc="left") == "t = 200 s"
    assert axes.child_axes[0].get_ylabel() == "Pressure (MPa)"


def test_the_edge_of_the_contact_runs_between_cells_with_and_without_pressure(result):
    (axes,) = pressure_map(result).axes
    (edge,) = axes.collections[0].get_paths()
    r = np.hypot(edge.vertices[:, 0], edge.vertices[:, 1] / 1.1)
    assert np.max(np.abs(r - 1e3 * half_width(3600.0))) < 1.5e3 * max(GRID.spacing)


def test_the_map_marks_the_ellipse_of_hertz(result):
    figure = pressure_map(result)
    ((x, y),) = curves(figure.axes[0]).values()
    assert names(figure.legends[0]) == {"Hertz, 0 s"}
    hertz = hertz_contact(result.system)
    np.testing.assert_allclose(np.hypot(x / hertz.half_width_x, y / hertz.half_width_y), 1e3)


def test_worn_bodies_touch_but_do_not_overlap(result):
    along, across = (
        axes.lines[0].get_ydata() - axes.lines[1].get_ydata() for axes in worn_section(result).axes
    )
    assert min(along.min(), across.min()) > -1e-9
    # They come together within the scar, to less than the ball's sag over a cell.
    sag = 1e6 * half_width(3600.0) * GRID.spacing[1] / 5e-3
    assert across.min() < sag


def test_the_swept_body_lies_below_and_depths_of_scars_are_stated():
    result = made(swept=(True, False))
    along, across = worn_section(result).axes
    assert [text.get_text() for text in along.texts] == ["disk", "ball"]
    for name, text in zip(("disk", "ball"), across.texts, strict=True):
        value, unit = text.get_text().removeprefix(f"{name}: ").removesuffix(" deep").split()
        expected = result.body(name).wear_depth[-1].max() * {"µm": 1e6, "nm": 1e9}[unit]
        assert float(value) == pytest.approx(expected, rel=1e-2)


def test_volume_and_mass_are_the_histories(result):
    figure = wear_history(result)
    axes = figure.axes[0]
    history = result.table("history")
    shown = curves(axes)
    assert set(shown) == {"ball", "disk"} == names(figure.legends[0])
    np.testing.assert_allclose(shown["ball"][0], history["time_s"])
    line = axes.lines[0]
    np.testing.assert_allclose(line.get_xdata()[line.get_markevery()], TIMES)
    np.testing.assert_allclose(shown["ball"][1], 1e9 * history["bodies.ball.wear_volume_m3"])


def test_two_moments_are_not_joined():
    for times, style in (((0.0,), "None"), ((0.0, 200.0), "-")):
        lines = wear_history(made(times)).axes[0].lines
        assert lines[0].get_linestyle() == style
        assert not any(line.get_clip_on() for line in lines)


@pytest.mark.parametrize(
    ("densities", "masses"),
    [
        ((7850.0, 7850.0), {"ball": 7.85, "disk": 7.85}),
        ((7850.0, 3200.0), {"ball": 7.85, "disk": 3.2}),
        ((7850.0, None), {"ball": 7.85}),
        ((None, None), {}),
    ],
)
def test_mass_has_a_panel_of_its_own(densities, masses):
    volume, *mass = wear_history(made(densities=densities)).axes
    assert len(mass) == bool(masses)
    for axes in mass:
        assert axes.get_ylabel() == "Mass worn (mg)"
        assert set(curves(axes)) == set(masses)
        for name, (_, y) in curves(axes).items():
            np.testing.assert_allclose(y, masses[name] * curves(volume)[name][1])


def test_contact_history_is_the_history(result):
    upper, lower = contact_history(result).axes
    history = result.table("history")
    pressures, widths = curves(upper), curves(lower)
    np.testing.assert_allclose(pressures["largest"][1], 1e-6 * history["max_pressure_Pa"])
    np.testing.assert_allclose(pressures["centre"][1], 1e-6 * history["centre_pressure_Pa"])
    for axis, label in zip("xy", ("along sliding", "across sliding"), strict=True):
        np.testing.assert_allclose(
            widths[label], (history["time_s"], 1e6 * history[f"contact_half_width_{axis}_m"])
        )
    assert lower.get_title(loc="right") == "± 1 cell, 40 µm"
    assert all(axes.get_legend() for axes in (upper, lower))
