"""Output to a stream that knows only ASCII, or Latin-1."""

import os
import subprocess
import sys

import pytest
from made_results import written


@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "utf-8"])
def test_a_result_is_shown_whatever_the_stream_can_carry(tmp_path, encoding):
    written(tmp_path / "x.h5")
    done = subprocess.run(
        [sys.executable, "-m", "tribo", "show", "x.h5"],
        cwd=tmp_path,
        capture_output=True,
        env={**os.environ, "LC_ALL": "C", "PYTHONIOENCODING": encoding},
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    text = done.stdout.decode(encoding)
    assert {"ascii": "mm^3/(N*m)"}.get(encoding, "mm³/(N·m)") in text
    assert "?" not in text
