"""Tables of numbers are read, and what is none is named."""

import time
import zipfile

import h5py
import numpy as np
import pytest

from tribo.core import number_tables
from tribo.core.hdf5 import contained
from tribo.core.number_tables import read_numbers, table_of_numbers


@pytest.mark.parametrize("suffix", [".npy", ".csv"])
def test_an_empty_file_is_called_so(suffix, tmp_path):
    path = tmp_path / f"a{suffix}"
    path.touch()
    with pytest.raises(ValueError, match=rf"a\{suffix} is empty"):
        table_of_numbers(path)


def test_what_is_named_as_an_array_and_is_none_is_told(tmp_path):
    path = tmp_path / "a.npy"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("heights", "1")
    others = [path.read_bytes(), path.read_bytes()[:20], b"\x93N", b"1, 2\n"]
    np.save(path, np.array([{}], dtype=object), allow_pickle=True)
    for content in [path.read_bytes(), *others]:
        path.write_bytes(content)
        with pytest.raises(ValueError, match=r"a\.npy cannot .*: it is no NumPy array and no text"):
            table_of_numbers(path)


TWO = "1,2\n3,4\n"


def test_a_csv_file_may_have_a_header_and_missing_values(tmp_path):
    path = tmp_path / "a.csv"
    for head in ("", "x,y\n", "\ufeffheights in m\n", "# heights\n\n"):
        path.write_text(head + "nan,\n" + TWO, encoding="utf-8")
        found = table_of_numbers(path)
        np.testing.assert_array_equal(found, [[np.nan, np.nan], [1, 2], [3, 4]])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("1,2\n3,hello\n", "line 2 has 'hello', which is no number"),
        ("scan 5\nx,y\n" + TWO, "line 2 has 'x', .* one header line at most"),
        ("1.5;2\n3;4\n", r"line 2 has '3;4', .* by commas, with decimal points, as 1\.5"),
        (TWO + "5,6,7\n8\n", "line 3 has 3 values"),
        ("x,y\n", "it has no line of numbers"),
    ],
)
def test_what_is_wrong_in_a_csv_file_is_told_with_its_line(text, words, tmp_path):
    (tmp_path / "a.csv").write_text(text)
    with pytest.raises(ValueError, match=rf"a\.csv cannot be read .*: {words}"):
        table_of_numbers(tmp_path / "a.csv")


@pytest.mark.parametrize(("values", "kind"), [([1j], "complex128"), ([True], "bool")])
def test_an_array_of_other_than_real_numbers_is_told(values, kind, tmp_path):
    np.save(tmp_path / "a.npy", np.array(values))
    with pytest.raises(ValueError, match=rf"a\.npy has values of type {kind}; save real numbers"):
        read_numbers(tmp_path / "a.npy")


def huge_npy(path):
    with path.open("wb") as file:
        header = {"descr": "<f8", "fortran_order": False, "shape": (30000, 30000)}
        np.lib.format.write_array_header_1_0(file, header)
        # Its holes take no space on the disk.
        file.truncate(file.tell() + 8 * 30000**2)


def test_a_map_with_too_many_pixels_is_refused_before_it_is_read(tmp_path):
    huge_npy(tmp_path / "a.npy")
    with pytest.raises(ValueError, match=r"900,000,000 .* 67,108,864"):
        table_of_numbers(tmp_path / "a.npy")


def test_a_text_with_too_many_numbers_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(number_tables, "MOST_PIXELS", 99)
    (tmp_path / "a.csv").write_text("1,2\n" * 60)
    with pytest.raises(ValueError, match=r"100 .* 99"):
        table_of_numbers(tmp_path / "a.csv")


def test_groups_that_nest_deeply_or_in_a_ring_are_read_through(tmp_path):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        group = file
        for _ in range(5000):
            group = group.create_group("a")
        group["heights"] = np.ones((3, 4))
        group["root"] = file["/"]
        begun = time.process_time()
        assert [each.shape for each in contained(file)] == [(3, 4)]
    # It took 60 s where each group was looked up by its whole path.
    assert time.process_time() - begun < 10


def test_where_a_number_is_missing_is_told(tmp_path):
    np.save(tmp_path / "a.npy", [[1.0, 2.0], [3.0, np.nan]])
    with pytest.raises(ValueError, match=r"1 of the 4 values of .* at \(2, 2\), counted from 1;"):
        read_numbers(tmp_path / "a.npy")
