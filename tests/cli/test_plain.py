"""Output to a stream that knows only ASCII, or Latin-1."""

import os
import subprocess
import sys

import pytest
from made_results import made

from tribo.result.seal import write_sealed


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("plain")
    file = made()._file.file
    file.flush()
    image = file.id.get_file_image()
    write_sealed(folder / "x.h5", image, identity=bytes(16), sync=False)
    return folder


@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "utf-8"])
def test_a_result_is_shown_whatever_the_stream_can_carry(folder, encoding):
    done = subprocess.run(
        [sys.executable, "-m", "tribo", "show", "x.h5"],
        cwd=folder,
        capture_output=True,
        env={**os.environ, "LC_ALL": "C", "PYTHONIOENCODING": encoding},
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    text = done.stdout.decode(encoding)
    assert {"ascii": "mm^3/(N*m)"}.get(encoding, "mm³/(N·m)") in text
    assert "?" not in text
