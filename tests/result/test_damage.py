"""A damaged file is refused with one line, and one is replaced whole or not at all."""

import subprocess
import sys

import pytest
from made_results import made

from tribo import CaseError
from tribo.result.sealed import check_sealed, write_sealed


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    path = tmp_path_factory.mktemp("damage") / "run.h5"
    with made() as result:
        result.save(path)
    return path


def written(path, data):
    write_sealed(path, data, sync=False)


def test_every_bit_counts(tmp_path):
    path = tmp_path / "file"
    written(path, bytes(range(256)) * 4)
    sound = path.read_bytes()
    damages = [
        sound[:at] + bytes([sound[at] ^ 1 << at % 8]) + sound[at + 1 :]
        for at in range(0, len(sound), 7)
    ]
    damages += [sound[:length] for length in range(0, len(sound), 101)]
    damages += [sound + b"\0", sound[100:200] + sound[:100] + sound[200:], sound[:100] + sound]
    for damage in damages:
        path.write_bytes(damage)
        with pytest.raises(CaseError, match=r"damaged|not a whole"):
            check_sealed(path)
    path.write_bytes(sound)
    check_sealed(path)


def test_what_fails_to_be_written_leaves_the_file_as_it_was(tmp_path):
    path = tmp_path / "file"
    written(path, b"first")
    with pytest.raises(TypeError):
        written(path, "no bytes")
    check_sealed(path)
    assert path.read_bytes().startswith(b"first")
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(
    ("damage", "words"),
    [
        (lambda data: b"", "is not a whole tribo file"),
        (lambda data: b"not a result", "is not a whole tribo file but text"),
        (lambda data: data[:-1], "is not a whole tribo file"),
        (lambda data: data[:-40], "is not a whole tribo file"),
        (lambda data: b"\x89HDF\r\n\x1a\n" + bytes(500), "is not a whole tribo file"),
        (lambda data: bytes([data[0] ^ 1]) + data[1:], "is damaged: its checksum"),
        (lambda data: data[:5000] + bytes([data[5000] ^ 1]) + data[5001:], "is damaged: its check"),
    ],
    ids=["empty", "text", "cut", "no checksum", "other HDF5", "first bit", "a bit"],
)
def test_show_refuses_it_in_one_line(sound, tmp_path, damage, words):
    path = tmp_path / "damaged.h5"
    path.write_bytes(damage(sound.read_bytes()))
    done = subprocess.run(
        [sys.executable, "-m", "tribo", "show", str(path)], capture_output=True, text=True
    )
    assert (done.returncode, done.stdout) == (2, "")
    (line,) = done.stderr.splitlines()
    assert f"damaged.h5 {words}" in line


def test_a_result_left_open_does_no_harm_at_the_end(sound):
    code = f"import tribo; result = tribo.open({str(sound)!r}); print(result.times)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True)
    assert (done.returncode, done.stderr) == (0, b"")
