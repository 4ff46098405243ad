"""What a result file keeps, and how other programs read it."""

import numpy as np
import pytest
import xarray
from made_results import made
from paper_models import archard, flat, named, small, sphere, steel

import tribo
from tribo import CaseError, Material, Result, Simulation


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    dense = Material(young="207 GPa", poisson=0.3, density="7850 kg/m^3")
    path = tmp_path_factory.mktemp("result") / "run.h5"
    model = small(
        save_times=(20,),
        bodies=[
            named("ball", sphere(), dense, archard()),
            named("disk", flat(), steel(), archard()),
        ],
    )
    Simulation(model.case).run(path).close()
    return path


@pytest.mark.slow
def test_it_is_a_dataset_that_xarray_reads_without_tribo(path):
    with tribo.open(path) as result, xarray.open_dataset(path, engine="h5netcdf") as data:
        xarray.testing.assert_identical(result.dataset, data)
        assert data.pressure.dims == ("time", "x", "y")
        assert data.wear_depth.dims == ("time", "body", "x", "y")
        assert data.history_wear_volume.dims == ("step", "body")
        assert list(data.body) == ["ball", "disk"]
        assert data.swept.values.tolist() == [0, 1]
        np.testing.assert_array_equal(data.time, [0, 20, 200])
        for name, variable in data.variables.items():
            if name != "body":
                assert {"units", "long_name"} <= variable.attrs.keys()
        worn = result.wear_depth.sel(body="disk").sel(time=19, method="nearest")
        assert float(worn.max()) > 0


@pytest.mark.slow
def test_a_result_in_memory_is_the_same_dataset_and_can_be_saved(tmp_path):
    with made() as result:
        result.save(tmp_path / "saved.h5")
        with tribo.open(tmp_path / "saved.h5") as saved:
            xarray.testing.assert_identical(saved.dataset, result.dataset)


def test_its_variables_are_attributes():
    with made() as result:
        drawn = result.max_pressure.plot()
        assert len(drawn) == 1
        assert {"pressure", "wear_volume", "history_time"} <= set(dir(result))


def test_surfaces_and_volumes_belong_together(path):
    with Result.open(path) as result:
        ball = result.body("ball")
        saves = result.saves()
        grid = result.grid
    assert ball.density == 7850
    assert not ball.swept
    removed = (ball.surface(0) - ball.surface(-1)).sum() * grid.cell_area
    assert removed == pytest.approx(saves[-1]["bodies"]["ball"]["wear_volume_m3"], rel=1e-9, abs=0)


def test_the_history_has_a_row_a_step(path):
    with Result.open(path) as result:
        history, totals = result.table("history"), result.totals()
    assert len(history["time_s"]) == totals["steps"] + 1
    assert np.all(np.diff(history["time_s"]) > 0)
    assert np.all(np.diff(history["bodies.ball.wear_volume_m3"]) > 0)


@pytest.mark.parametrize("save", [3, 17, -4])
def test_a_save_out_of_range_is_refused_with_how_many_there_are(path, save):
    with Result.open(path) as result:
        with pytest.raises(CaseError, match=f"no save {save}; it has 3, counted from 0"):
            result.field("pressure", save)
        with pytest.raises(CaseError, match=f"no save {save}; it has 3, counted from 0"):
            result.field("wear_depth", save, "ball")
        ball = result.body("ball")
    with pytest.raises(CaseError, match=f"'ball' has no save {save}; it has 3, counted from 0"):
        ball.surface(save)


def test_a_save_is_found_by_its_time_within_rounding_and_as_it_is_printed():
    result = made(times=(0.0, 0.1 + 0.2, 3600.0))
    assert [result.save_at(time) for time in (0, 0.3, 3600 * (1 + 1e-15))] == [0, 1, 2]
    assert made(times=(0.0, 1492.0775914865187)).save_at(1492.08) == 1
    for time in (0.31, 3599, 3601, -1, float("nan")):
        with pytest.raises(CaseError, match=r"no saved time .* s; .* 0, 0\.3, 3600 s"):
            result.save_at(time)
