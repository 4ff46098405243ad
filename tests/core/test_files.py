"""A file is written whole or not at all."""

import zipfile

import numpy as np
import pytest

from tribo.core.errors import OutputError
from tribo.core.files import table_of_numbers, write_whole


def test_what_cannot_be_written_leaves_the_old_file_alone(tmp_path):
    path = tmp_path / "a.csv"
    write_whole(path, "old\n")
    (tmp_path / "a.csv.new").mkdir()
    with pytest.raises(OutputError, match=r"cannot write to .*a\.csv: Is a directory"):
        write_whole(path, "new\n")
    assert path.read_text() == "old\n"


@pytest.mark.parametrize("suffix", [".npy", ".csv", ".h5"])
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
        with pytest.raises(ValueError, match=r"a\.npy cannot .*: it is no NumPy array of numbers"):
            table_of_numbers(path)
