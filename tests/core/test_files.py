"""A file is written whole or not at all."""

import pytest

from tribo.core.errors import OutputError
from tribo.core.files import write_whole


def test_what_cannot_be_written_leaves_the_old_file_alone(tmp_path):
    path = tmp_path / "a.csv"
    write_whole(path, "old\n")
    (tmp_path / "a.csv.new").mkdir()
    with pytest.raises(OutputError, match=r"cannot write to .*a\.csv: Is a directory"):
        write_whole(path, "new\n")
    assert path.read_text() == "old\n"
