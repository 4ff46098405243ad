"""What the pictures show is what the result holds."""

import numpy as np
import pytest
from made_results import GRID, TIMES, half_width, made

from tribo.lab.against_hertz import hertz_contact
from tribo.plotting.history import history
from tribo.plotting.pressure import pressure_map, pressure_sections
from tribo.plotting.profiles import body_profiles, worn_section
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
    (axes,) = body_profiles(result, "ball", axis=axis).figure().axes
    shown = curves(axes)
    assert list(shown) == ["0 s", "200 s", "500 s", "1500 s", "3600 s"]
    ball = result.body("ball")
    for save, (x, y) in enumerate(ends[:, 1:-1] for ends in shown.values()):
        np.testing.assert_allclose(x, 1e3 * (GRID.x, GRID.y)[axis])
        np.testing.assert_allclose(y, 1e6 * profile(ball.surface(save), axis), atol=1e-12)
    assert np.all(shown["0 s"][1] >= shown["3600 s"][1])


def test_sections_hold_every_save_and_hertz_beside_the_first(result):
    figure = pressure_sections(result).figure()
    first, later = figure.axes[:2], figure.axes[2:]
    hertz = hertz_contact(result.system)
    for axis in (0, 1):
        assert set(curves(first[axis])) == {"0 s", "Hertz, 0 s"}
        shown = curves(first[axis]) | curves(later[axis])
        assert len(shown) == len(TIMES) + 1
        x, y = shown.pop("Hertz, 0 s")
        assert y.max() == pytest.approx(1e-6 * hertz.peak_pressure, rel=1e-3)
        unit = {"mm": 1e3, "µm": 1e6}[first[axis].get_xlabel()[-3:-1]]
        assert x[y > 0].max() == pytest.approx(unit * hertz.half_width_x, rel=0.02)
        for save, (_, y) in enumerate(shown.values()):
            expected = 1e-6 * profile(result.field("pressure", save), axis)
            np.testing.assert_allclose(y[1:-1], expected)
    assert names(figure.legends[0]) == set(curves(first[0])) | set(curves(later[0]))


def test_the_map_is_the_pressure_from_zero_to_a_percentile_that_it_states(result):
    (axes,) = pressure_map(result, 1).figure().axes
    (image,) = axes.images
    pressure = 1e-6 * result.field("pressure", 1).T
    shown = np.ma.filled(image.get_array(), np.nan)
    np.testing.assert_allclose(shown, np.where(pressure > 0, pressure, np.nan))
    np.testing.assert_allclose(image.get_extent(), [-1.0, 1.0, -0.8, 0.8])
    assert image.get_clim() == (0.0, pytest.approx(np.percentile(pressure[pressure > 0], 99)))
    assert axes.get_title(loc="left") == "t = 200 s"
    label, largest = axes.child_axes[0].get_ylabel().split("; largest ")
    assert label == "Pressure (MPa)\nto 99 % of cells"
    assert float(largest) == pytest.approx(result.saves()[1]["max_pressure_Pa"] / 1e6, rel=1e-3)


def test_worn_bodies_touch_but_do_not_overlap(result):
    along, across = (
        axes.lines[0].get_ydata() - axes.lines[1].get_ydata()
        for axes in worn_section(result).figure().axes
    )
    assert min(along.min(), across.min()) > -1e-9
    # They come together within the scar, to less than the ball's sag over a cell.
    sag = 1e6 * half_width(3600.0) * GRID.spacing[1] / 5e-3
    assert across.min() < sag


def test_the_volume_is_the_history_over_time_and_distance(result):
    (volume,) = history(result, "wear").figure().axes
    table = result.table("history")
    shown = curves(volume)
    np.testing.assert_allclose(shown["ball"][0], table["time_s"])
    line = volume.lines[0]
    np.testing.assert_allclose(line.get_xdata()[line.get_markevery()], TIMES)
    assert volume.get_ylabel() == "Volume worn (mm³)"
    for name in ("ball", "disk"):
        np.testing.assert_allclose(shown[name][1], 1e9 * table[f"bodies.{name}.wear_volume_m3"])
    # 0.1 m/s.
    (above,) = (axes for axes in volume.child_axes if axes.get_xlabel() == "Distance (m)")
    volume.figure.draw_without_rendering()
    np.testing.assert_allclose(above.get_xlim(), 0.1 * np.array(volume.get_xlim()))


def test_the_history_of_the_contact_is_that_of_the_table_with_a_cell_on_either_side(result):
    pressure, width, area = history(result, "contact").figure().axes
    table = result.to_dataframe()
    last = {name: y[-1] for axes in (pressure, width) for name, (_, y) in curves(axes).items()}
    assert last["largest"] == pytest.approx(table["p max (MPa)"].iloc[-1])
    assert last["centre"] == pytest.approx(table["p centre (MPa)"].iloc[-1])
    assert width.get_ylabel() == "Contact width (mm)"
    for way, band in zip(("along", "across"), width.collections, strict=True):
        drawn, cell = last[f"{way} sliding"], 1e3 * GRID.spacing[way == "across"]
        assert drawn == pytest.approx(1e-3 * table[f"width {way} (µm)"].iloc[-1])
        (outline,) = band.get_paths()
        end = outline.vertices[outline.vertices[:, 0] == TIMES[-1], 1]
        assert (end.min(), end.max()) == pytest.approx((drawn - cell, drawn + cell))
    (line,) = area.lines
    assert line.get_ydata()[-1] == pytest.approx(table["area (mm²)"].iloc[-1])


def test_the_contact_area_is_drawn_with_its_part_at_the_hardness():
    rough = made(relief=2e-7, cap=4e8)
    *_, axes = history(rough, "contact").figure().axes
    for line, column in zip(axes.lines, ("contact_area_m2", "plastic_area_m2"), strict=True):
        np.testing.assert_allclose(line.get_ydata(), 1e6 * rough.table("history")[column])
