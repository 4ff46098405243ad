"""What a result file keeps, and how other programs read it."""

import h5py
import numpy as np
import pytest
import xarray
from made_results import made
from paper_models import archard, flat, named, small, sphere, steel

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


def test_xarray_reads_it_with_names_and_units(path):
    with xarray.open_dataset(path, engine="h5netcdf") as data:
        assert data.pressure.dims == ("time", "x", "y")
        assert data.pressure.attrs["units"] == "Pa"
        np.testing.assert_array_equal(data.time, [0, 20, 200])
        assert data.x.attrs["units"] == "m"
        assert float(data.pressure.sel(time=20).sum()) > 0
    with xarray.open_dataset(path, engine="h5netcdf", group="bodies/disk") as disk:
        assert disk.wear_depth.dims == ("time", "y")


def test_every_dataset_has_a_checksum(path):
    with h5py.File(path) as file:
        datasets = []
        file.visititems(
            lambda _, item: datasets.append(item) if isinstance(item, h5py.Dataset) else None
        )
        assert len(datasets) > 40
        assert all(dataset.fletcher32 for dataset in datasets)


def test_a_flipped_byte_is_noticed(path, tmp_path):
    with h5py.File(path) as file:
        offset = file["pressure"].id.get_chunk_info(2).byte_offset
    data = bytearray(path.read_bytes())
    data[offset + 100] ^= 1
    damaged = tmp_path / "damaged.h5"
    damaged.write_bytes(data)
    with Result.open(damaged) as result, pytest.raises(CaseError, match="damaged: 'pressure'"):
        result.pressure(2)


def test_the_result_says_what_made_it(path):
    with Result.open(path) as result:
        made = result.provenance
    assert {"tribo", "numpy", "scipy"} <= made["packages"].keys()
    assert made["components"]["contact"]["class"] == "tribo.contact.dcfft.DcFft"
    assert made["components"]["bodies.ball.wear"]["type"] == "archard"
    assert made["components"]["contact"]["distribution"] == "tribo"


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


@pytest.mark.parametrize("content", [b"", b"not a result", b"\x89HDF\r\n\x1a\n" + b"\0" * 500])
def test_other_files_are_refused(tmp_path, content):
    path = tmp_path / "other.h5"
    path.write_bytes(content)
    with pytest.raises(CaseError, match=r"other\.h5 is not a whole tribo file"):
        Result.open(path)


def test_other_hdf5_files_are_refused(tmp_path):
    path = tmp_path / "other.h5"
    h5py.File(path, "w").close()
    with pytest.raises(CaseError, match=r"not a whole tribo file .*written to it"):
        Result.open(path)


def test_a_result_says_what_it_is(path):
    with Result.open(path) as result:
        assert repr(result) == f"<Result {path}: done, 3 saves at 0, 20, 200 s>"
    assert repr(result) == f"<Result {path}: closed>"


def test_many_saves_are_not_all_listed():
    shown = repr(made(times=tuple(range(30))))
    assert shown == "<Result made: done, 30 saves at 0, 1, 2, 3, 4, 5, …, 29 s>"


@pytest.mark.parametrize("save", [3, 17, -4])
def test_a_save_out_of_range_is_refused_with_how_many_there_are(path, save):
    with Result.open(path) as result:
        with pytest.raises(CaseError, match=f"no save {save}: it has 3 saves, 0 to 2"):
            result.pressure(save)
        with pytest.raises(CaseError, match=f"no save {save}: it has 3 saves, 0 to 2"):
            result.wear_depth("ball", save)
        ball = result.body("ball")
    with pytest.raises(CaseError, match=f"'ball' has no save {save}: it has 3 saves, 0 to 2"):
        ball.surface(save)


def test_saves_count_from_either_end(path):
    with Result.open(path) as result:
        np.testing.assert_array_equal(result.pressure(-1), result.pressure(2))
        np.testing.assert_array_equal(result.pressure(-3), result.pressure(0))


def test_the_wear_depth_of_a_save_is_that_of_the_body(path):
    with Result.open(path) as result:
        for name in ("ball", "disk"):
            for save in (0, 2, -1):
                expected = result.body(name).wear_depth[save]
                np.testing.assert_array_equal(result.wear_depth(name, save), expected)
        with pytest.raises(CaseError, match="has no body 'bal'; its bodies are ball, disk"):
            result.wear_depth("bal", 0)


def test_a_save_is_found_by_its_time_within_rounding():
    result = made(times=(0.0, 0.1 + 0.2, 3600.0))
    assert [result.save_at(time) for time in (0, 0.3, 3600 * (1 + 1e-15))] == [0, 1, 2]
    for time in (0.31, 3599, 3601, -1, float("nan")):
        with pytest.raises(CaseError, match=r"no save at .* s; its saves are at 0, 0\.3, 3600 s"):
            result.save_at(time)
