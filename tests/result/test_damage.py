"""A damaged result says what of it is lost, and gives the rest."""

import json
import os
import subprocess
import sys

import h5py
import numpy as np
import pytest
from edited import edited
from paper_models import archard, flat, motion, named, small, sphere, steel

from tribo import CaseError, Grid, Interrupted, Result, Simulation
from tribo.core.errors import OutputError, TriboWarning
from tribo.observers.observer import Observer
from tribo.result.checkpoint import (
    checkpoint_path,
    previous_path,
    read_checkpoint,
    write_checkpoint,
)
from tribo.result.columns import COLUMNS
from tribo.result.store import read_text, write_text
from tribo.simulation.march import begin


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    path = tmp_path_factory.mktemp("damage") / "run.h5"
    Simulation(model().case).run(path).close()
    return path


def model():
    bodies = [
        named("ball", sphere(), steel(), archard()),
        named("disk", flat(), steel(), archard()),
    ]
    # Fields large enough that their middles share no page with another.
    grid = Grid((0.7e-3, 0.7e-3), (96, 96))
    return small(grid=grid, bodies=bodies, kinematics=motion(duration=60), save_times=(20,))


def chunk(path, name, number):
    """Where a chunk of a dataset lies in the file: its first byte and its size."""
    with h5py.File(path) as file:
        info = file[name].id.get_chunk_info(number)
    return info.byte_offset, info.size


def damaged(sound, folder, *offsets):
    data = bytearray(sound.read_bytes())
    for offset in offsets:
        data[offset] ^= 1
    path = folder / "damaged.h5"
    path.write_bytes(data)
    return path


def show(path):
    return subprocess.run(
        [sys.executable, "-m", "tribo", "show", str(path)],
        capture_output=True,
        text=True,
        check=False,
    )


def test_show_names_the_field_and_the_save_that_are_lost(sound, tmp_path):
    offset, size = chunk(sound, "pressure", 1)
    done = show(damaged(sound, tmp_path, offset + size // 2))
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.endswith("damaged.h5 is damaged: 'pressure' of save 1 cannot be read\n")


def test_the_rest_can_be_read(sound, tmp_path):
    offset, size = chunk(sound, "pressure", 1)
    with (
        Result.open(damaged(sound, tmp_path, offset + size // 2)) as result,
        Result.open(sound) as whole,
    ):
        with pytest.raises(CaseError, match="is damaged: 'pressure' of save 1 cannot be read"):
            result.pressure(1)
        for save in (0, 2):
            np.testing.assert_array_equal(result.pressure(save), whole.pressure(save))
        assert result.saves() == whole.saves()


@pytest.mark.parametrize("offset", [0, 100, 700])
def test_damage_at_the_root_is_one_message(sound, tmp_path, offset):
    done = show(damaged(sound, tmp_path, offset))
    assert done.returncode == 2
    (line,) = done.stderr.splitlines()
    assert "damaged.h5 is damaged" in line


def test_much_damage_is_summed_up(sound, tmp_path):
    names = [f"saves/{column.name}" for column in COLUMNS]
    path = damaged(sound, tmp_path, *(sum(chunk(sound, name, 0)) - 1 for name in names))
    with Result.open(path) as result, pytest.raises(CaseError) as raised:
        result.check()
    assert " more cannot be read" in str(raised.value)
    assert len(str(raised.value)) < 500 + len(str(path))


def test_a_file_that_is_cut_short_says_so(sound, tmp_path):
    path = tmp_path / "short.h5"
    path.write_bytes(sound.read_bytes()[:-1])
    done = show(path)
    assert done.returncode == 2
    assert "is not a whole tribo file" in done.stderr


def test_a_damaged_file_whose_groups_go_round_in_a_circle_is_told(sound, tmp_path):
    path = tmp_path / "circle.h5"
    path.write_bytes(sound.read_bytes())
    with edited(path) as file:
        file["bodies/bodies"] = file["bodies"]
        chunk = file["pressure"].id.get_chunk_info(0)
    data = bytearray(path.read_bytes())
    data[chunk.byte_offset + chunk.size // 2] ^= 1
    path.write_bytes(data)
    with Result.open(path) as result, pytest.raises(CaseError, match="cannot be read"):
        result.check()


def test_a_claim_of_more_than_the_file_can_hold_takes_no_memory(sound, tmp_path):
    path = tmp_path / "claims.h5"
    path.write_bytes(sound.read_bytes())
    with edited(path) as file:
        file["bodies/ball/wear_depth"].resize(10**9, axis=0)
    with Result.open(path) as result, pytest.raises(CaseError, match="more than the file holds"):
        result.body("ball")


def test_a_text_is_no_larger_than_the_file_either(sound, tmp_path):
    path = tmp_path / "claims.h5"
    path.write_bytes(sound.read_bytes())
    with edited(path) as file:
        del file["case"]
        file.create_dataset("case", shape=(10**12,), chunks=(4096,), dtype="u1")
    with Result.open(path) as result, pytest.raises(CaseError, match=r"'case'.*the file holds"):
        _ = result.case


def larger(file):
    del file["pressure"]
    file.create_dataset("pressure", shape=(10**6, 10**6), chunks=(64, 64), dtype="f8")


def of_another_version(file):
    scalars = json.loads(read_text(file, "scalars"))
    scalars["invariants"]["unheard_of"] = 1.0
    del file["scalars"], file["scalars_bytes"]
    write_text(file, "scalars", json.dumps(scalars))


@pytest.mark.parametrize(
    ("change", "words"), [(larger, "the file holds"), (of_another_version, "unheard_of")]
)
def test_a_checkpoint_that_cannot_be_is_not_gone_on_with(sound, tmp_path, change, words):
    path = tmp_path / "run.h5"
    path.write_bytes(sound.read_bytes())
    with edited(path) as file:
        file.attrs["status"] = "interrupted"
    case = model().data
    write_checkpoint(path, begin(model()), 0.0, case)
    assert read_checkpoint(path, case)[0].steps == 0
    with edited(checkpoint_path(path)) as file:
        change(file)
    with pytest.raises(CaseError, match=rf"no checkpoint to resume from: .*{words}.*tribo run"):
        Simulation(model().case).resume(path)


def test_a_result_left_open_does_no_harm_at_the_end(sound):
    code = f"from tribo import Result; result = Result.open({str(sound)!r}); print(result.times)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, check=False)
    assert (done.returncode, done.stderr) == (0, b"")


class StopAt(Observer):
    time: float

    def on_save(self, snapshot):
        if snapshot.state.time == self.time:
            raise KeyboardInterrupt


@pytest.fixture
def stopped(tmp_path):
    path = tmp_path / "stopped.h5"
    with pytest.raises(Interrupted):
        Simulation(model().case).run(path, observers=[StopAt(time=20)])
    return path


def flip(path, at):
    data = bytearray(path.read_bytes())
    data[at] ^= 1
    path.write_bytes(data)


@pytest.mark.parametrize("at", [0, 1000, -5000, -1])
def test_a_flipped_bit_in_a_checkpoint_is_noticed_and_the_one_before_is_used(sound, stopped, at):
    flip(checkpoint_path(stopped), at)
    with pytest.warns(
        TriboWarning, match=r"ckpt is (damaged|not a whole).*: going on from stopped.h5.ckpt.pr"
    ):
        Simulation(model().case).resume(stopped).close()
    with Result.open(stopped) as result, Result.open(sound) as whole:
        np.testing.assert_array_equal(result.pressure(-1), whole.pressure(-1))
        np.testing.assert_array_equal(result.times, whole.times)


def test_two_damaged_checkpoints_are_an_error_that_names_both(stopped):
    for path in (checkpoint_path(stopped), previous_path(stopped)):
        flip(path, 2000)
    with pytest.raises(CaseError, match=r"no checkpoint .*ckpt is damaged.*prev is damaged"):
        Simulation(model().case).resume(stopped)


def test_a_damaged_result_is_not_gone_on_with(stopped):
    offset, size = chunk(stopped, "pressure", 0)
    flip(stopped, offset + size // 2)
    with pytest.raises(CaseError, match="'pressure' of save 0 cannot be read"):
        Simulation(model().case).resume(stopped)


@pytest.mark.parametrize(
    "name", ["a" * 300 + ".h5", "a" * 253 + ".h5", "a" * 250 + ".h5"], ids=["300", "256", "253"]
)
def test_an_output_that_cannot_be_written_is_one_message(tmp_path, name):
    with pytest.raises(OutputError, match=r"cannot write .*too long.*choose another place"):
        Simulation(model().case).run(tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_a_device_is_not_replaced(tmp_path):
    link = tmp_path / "pipe"
    os.mkfifo(link)
    with pytest.raises(CaseError, match="not a file that could be replaced"):
        Simulation(model().case).run(link, overwrite=True)


def test_a_result_may_be_a_link(sound, tmp_path):
    link, there = tmp_path / "link.h5", tmp_path / "there.h5"
    there.write_text("old")
    link.symlink_to(there)
    Simulation(model().case).run(link, overwrite=True).close()
    assert link.is_symlink()
    with Result.open(there) as result, Result.open(sound) as whole:
        np.testing.assert_array_equal(result.pressure(-1), whole.pressure(-1))
