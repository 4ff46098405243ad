"""What the pictures of a rough body show is what the lab measures."""

import numpy as np
import pytest
from made_results import made

from tribo.lab.running_in import reliefs
from tribo.plotting.history import history
from tribo.plotting.profiles import height_map, material_ratio_curves


@pytest.fixture(scope="module")
def rough():
    return made(relief=2e-7)


def test_height_maps_are_of_the_scar_before_and_after_in_one_scale(rough):
    maps = height_map(rough, "ball").figure().axes
    scar, unworn, _ = reliefs(rough, rough.body("ball"), -1)
    assert [axes.get_title(loc="left") for axes in maps] == ["ball, unworn", "ball, t = 3600 s"]
    for axes, relief in zip(maps, (unworn, scar), strict=True):
        (image,) = axes.images
        np.testing.assert_allclose(
            np.ma.filled(image.get_array(), np.nan), 1e9 * relief.T, atol=1e-9
        )
    assert maps[0].images[0].get_clim() == maps[1].images[0].get_clim()


def test_material_ratio_curves_fall_through_all_heights(rough):
    (axes,) = material_ratio_curves(rough, "ball").figure().axes
    assert [line.get_label() for line in axes.lines] == ["scar, 3600 s", "unworn", "beside"]
    for line, relief in zip(axes.lines, reliefs(rough, rough.body("ball"), -1), strict=True):
        ratio, height = line.get_xydata().T
        assert np.all(np.diff(height) <= 0)
        assert (height[0], height[-1]) == pytest.approx(
            (1e9 * np.nanmax(relief), 1e9 * np.nanmin(relief))
        )
        assert 0 < ratio[0] < 1 < 99 < ratio[-1] < 100


def test_the_contact_area_is_drawn_with_its_part_at_the_hardness():
    result = made(relief=2e-7, cap=4e8)
    *_, axes = history(result, "contact").figure().axes
    table = result.table("history")
    for line, column in zip(axes.lines, ("contact_area_m2", "plastic_area_m2"), strict=True):
        np.testing.assert_allclose(line.get_ydata(), 1e6 * table[column])
    assert axes.get_ylabel() == "Contact area (mm²)"
