"""Roughness of worn bodies in a result."""

from importlib.resources import files

import numpy as np
import pytest
from tribo import load_case
from tribo import open as open_result

from tribo_topography.hooks import tribo_figures
from tribo_topography.roughness import roughness
from tribo_topography.running_in import (
    outlined,
    reliefs,
    rough_bodies,
    scar_cells,
    worn_roughness,
)

WAVES = 'type = "rough", sq = "50 nm", cut_off = "0.125 mm", roll_off = "0.25 mm"'
ROUGH = [
    "grid.size='1 mm'",
    "grid.cells=32",
    f"bodies.ball.surface={{ {WAVES}, seed = 1, on = {{ type = 'sphere', radius = '5 mm' }} }}",
    f"bodies.disk.surface={{ {WAVES}, seed = 2 }}",
    "kinematics.stroke='1 mm'",
    "kinematics.positions=25",
    "kinematics.duration='10 s'",
    "output.save_times=[0, 10]",
]


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    """A rough ball on a rough disk, the cycle resolved."""
    path = tmp_path_factory.mktemp("rough") / "rough.h5"
    run(path, *ROUGH).close()
    return path


def run(path, *overrides):
    template = files("tribo.templates") / "ball_on_disk.toml"
    return load_case(template, overrides=overrides).run(path)


def test_a_scar_has_its_unworn_valleys_too():
    x, y = np.indices((40, 30)) - 15
    scar = (x / 12) ** 2 + (y / 8) ** 2 < 1
    filled = outlined(scar & (np.random.default_rng(1).random(scar.shape) < 0.5))
    assert np.all(filled <= scar)
    assert np.count_nonzero(filled) > 0.85 * np.count_nonzero(scar)
    assert not outlined(np.zeros((3, 3), dtype=bool)).any()


def test_running_in_polishes_the_scar_and_leaves_the_rest(path):
    with open_result(path) as result:
        assert rough_bodies(result) == ["ball", "disk"]
        for body in map(result.body, result.body_names):
            first, last = (worn_roughness(result, body, save) for save in (0, 1))
            # Before any wear the surface under the contact is the unworn one.
            assert first.scar == first.unworn
            assert last.scar.Sq_m < last.unworn.Sq_m
            assert last.scar.Sz_m < last.unworn.Sz_m
            # Nothing touches the rest, 50 nm rough in all.
            assert last.beside.Sq_m == pytest.approx(50e-9, rel=0.2, abs=0)
            worn = scar_cells(result, body, 1)
            height = np.where(worn, body.surface(1), np.nan)
            assert last.scar == roughness(height, 4)


def test_a_rough_body_has_quantities_and_pictures_of_its_relief(path):
    with open_result(path) as result:
        rows = {row.key: row.value for row in result.report().rows}
        scar, unworn, _ = worn_roughness(result, result.body("ball"), -1)
        assert rows["quantities.ball.Sq_m"] == scar.Sq_m
        assert rows["quantities.ball.Sa_unworn_m"] == unworn.Sa_m
        figures = tribo_figures(result)
        assert [*figures] == [
            f"{name}_{kind}"
            for name in ("ball", "disk")
            for kind in ("height_map", "material_ratio")
        ]
        relief = reliefs(result, result.body("ball"), -1)
        before, after = (axes.images[0] for axes in figures["ball_height_map"]().axes[:2])
        np.testing.assert_allclose(
            np.ma.filled(after.get_array(), np.nan), 1e9 * relief.scar.T, atol=1e-9
        )
        assert before.get_clim() == after.get_clim()
        (axes,) = figures["ball_material_ratio"]().axes
        for line, heights in zip(axes.lines, relief, strict=True):
            ratio, height = line.get_xydata().T
            assert height[0] == pytest.approx(1e9 * np.nanmax(heights))
            assert 0 < ratio[0] < 1 < 99 < ratio[-1] < 100


def test_smooth_bodies_have_no_roughness(tmp_path):
    with run(tmp_path / "smooth.h5", *(each for each in ROUGH if "surface" not in each)) as result:
        assert rough_bodies(result) == []
        assert not result.report().rows
        assert not tribo_figures(result)
