"""A damaged file is refused with one line, and one is replaced whole or not at all."""

import subprocess
import sys

import pytest
from edited import edited
from made_results import made

from tribo import CaseError, Result
from tribo.result.sealed import open_sealed, write_sealed


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    path = tmp_path_factory.mktemp("damage") / "run.h5"
    with made() as result:
        result.save(path)
    return path


def test_every_bit_counts(tmp_path):
    path = tmp_path / "file"
    write_sealed(path, bytes(range(256)) * 4)
    sound = path.read_bytes()
    damages = [
        sound[:at] + bytes([sound[at] ^ 1 << at % 8]) + sound[at + 1 :]
        for at in range(0, len(sound), 7)
    ]
    damages += [sound[:length] for length in range(0, len(sound), 101)]
    damages += [sound + b"\0", sound[100:200] + sound[:100] + sound[200:], sound[:100] + sound]
    for damage in damages:
        path.write_bytes(damage)
        with pytest.raises(CaseError, match="is damaged"):
            open_sealed(path)
    path.write_bytes(sound)
    open_sealed(path).close()


@pytest.mark.parametrize("number", [1, [2, 2]])
def test_another_format_is_refused_with_both_numbers(sound, tmp_path, number):
    path = tmp_path / "old.h5"
    path.write_bytes(sound.read_bytes())
    with edited(path) as file:
        file.attrs["tribo_format"] = number
    with pytest.raises(CaseError, match=r"has format (1|\[2 2\]), and this tribo reads format 2"):
        Result.open(path)


NEVER_COLLECTED = """
import ctypes
from io import BytesIO
from pathlib import Path
from tribo import Result
result = Result(BytesIO(Path({path!r}).read_bytes()), "it")
ctypes.pythonapi.Py_IncRef(ctypes.py_object(result))
result.pressure
"""


@pytest.mark.parametrize(
    "code", ["import tribo; print(tribo.open({path!r}).times)", NEVER_COLLECTED]
)
def test_a_result_left_open_does_no_harm_at_the_end(sound, code):
    code = code.format(path=str(sound))
    done = subprocess.run([sys.executable, "-c", code], capture_output=True)
    assert (done.returncode, done.stderr) == (0, b"")
