"""Sealed files: all that was committed or none of it, and no bit of it changed."""

import errno
import io
import random
import struct
from contextlib import closing
from hashlib import sha256

import pytest
from paper_models import case, motion

from tribo import CaseError, Simulation
from tribo.core import locks
from tribo.core.errors import TriboWarning
from tribo.result import sealed_file, sealed_writer
from tribo.result.checkpoint import checkpoint_path
from tribo.result.journal import journal_path
from tribo.result.seal import PAGE, NotSealedError, write_sealed
from tribo.result.sealed_file import DamagedError, SealedFile
from tribo.result.sealed_writer import SealedWriter


class KilledError(BaseException):
    """Stands for the end of the process."""


def content(path):
    with closing(SealedFile(path)) as file:
        return file.read()


def scribble(file, chance):
    """Write, shorten and lengthen at random."""
    end = file.seek(0, io.SEEK_END)
    for _ in range(chance.randint(1, 6)):
        if chance.random() < 0.3:
            file.truncate(chance.randint(0, end + PAGE))
        else:
            file.seek(chance.randint(0, end + 2 * PAGE))
            file.write(chance.randbytes(chance.choice((1, 100, PAGE, 3 * PAGE + 7))))
        end = file.seek(0, io.SEEK_END)


def whole(file):
    file.seek(0)
    return file.read()


@pytest.mark.parametrize("seed", range(20))
def test_it_reads_as_any_file_would(tmp_path, seed):
    path = tmp_path / "file"
    chance, again = random.Random(seed), random.Random(seed)
    plain = io.BytesIO()
    with closing(SealedWriter.create(path)) as file:
        for _ in range(5):
            scribble(file, chance)
            scribble_plain(plain, again)
            assert whole(file) == plain.getvalue()
            file.commit(sync=chance.random() < 0.5)
            again.random()
            assert content(path) == plain.getvalue()
    with closing(SealedWriter(path)) as file:
        assert whole(file) == plain.getvalue()
        file.commit(sync=True)
    assert content(path) == plain.getvalue()
    assert [p.name for p in tmp_path.iterdir()] == ["file"]


def scribble_plain(plain, chance):
    """The same on a file in memory, whose `truncate` does not lengthen."""

    class Lengthening:
        seek, write = plain.seek, plain.write

        def truncate(self, size):
            end = plain.seek(0, io.SEEK_END)
            plain.write(bytes(max(0, size - end)))
            plain.truncate(size)

    scribble(Lengthening(), chance)


def test_what_is_not_committed_is_not_there(tmp_path):
    path = tmp_path / "file"
    with closing(SealedWriter.create(path)) as file:
        file.write(b"kept")
        file.commit(sync=True)
        file.write(b" lost")
        assert content(path) == b"kept"
    assert content(path) == b"kept"


@pytest.mark.parametrize("again", [False, True], ids=["read", "written on"])
def test_killed_at_any_write_it_holds_one_commit_or_the_next(tmp_path, monkeypatch, again):
    first, second = random.Random(1).randbytes(3 * PAGE), random.Random(2).randbytes(5 * PAGE + 9)
    seen = set()
    for at in range(20):
        path = tmp_path / f"file{at}"
        with closing(SealedWriter.create(path)) as file:
            file.write(first)
            file.commit(sync=at % 2 == 0)
            file.seek(100)
            file.write(second)
            with monkeypatch.context() as patch:
                countdown(patch, at)
                try:
                    file.commit(sync=True)
                    killed = False
                except KilledError:
                    killed = True
        if again:
            with closing(SealedWriter(path)) as file:
                file.seek(0, io.SEEK_END)
                file.write(b"more")
                file.commit(sync=True)
                assert not journal_path(path).exists()
        found = content(path)
        expected = (first, first[:100] + second)
        ends = [e + b"more" for e in expected] if again else list(expected)
        assert found in ends
        seen.add((ends.index(found), killed))
    # Killed before its journal was complete, after, and not at all.
    assert seen == {(0, True), (1, True), (1, False)}


def countdown(patch, at):
    """Let the process "die" half-way through a write, before a rename or before a removal."""
    left = [at]
    write_all = sealed_writer._write_all

    def die():
        left[0] -= 1
        if left[0] < 0:
            raise KilledError

    def half(file, data, position):
        if left[0] == 0:
            write_all(file, data[: len(data) // 2], position)
        die()
        write_all(file, data, position)

    def first(function):
        return lambda *args, **options: (die(), function(*args, **options))[1]

    patch.setattr(sealed_writer, "_write_all", half)
    for owner, name in ((sealed_writer.Path, "replace"), (sealed_writer.Path, "unlink")):
        patch.setattr(owner, name, first(getattr(owner, name)))


def test_after_a_power_failure_it_holds_the_last_commit_that_waited(tmp_path):
    path = tmp_path / "file"
    with closing(SealedWriter.create(path)) as file:
        file.write(bytes(3 * PAGE))
        file.commit(sync=True)
        for _ in range(3):
            file.write(b"later")
            file.seek(0)
            file.commit(sync=False)
    journal = journal_path(path)
    journal.write_bytes(journal.read_bytes()[:-100])
    with pytest.warns(TriboWarning, match="its journal is damaged"):
        assert content(path) == bytes(3 * PAGE)


def test_every_bit_counts(tmp_path):
    path = tmp_path / "file"
    write_sealed(path, bytes(range(256)) * 20, identity=bytes(16), sync=False)
    sound = path.read_bytes()
    for at in range(0, len(sound), 7):
        path.write_bytes(sound[:at] + bytes([sound[at] ^ 1 << at % 8]) + sound[at + 1 :])
        with pytest.raises((DamagedError, NotSealedError)):
            content(path)
    for length in range(0, len(sound), 101):
        path.write_bytes(sound[:length])
        with pytest.raises(NotSealedError):
            content(path)


def test_a_page_in_the_place_of_another_is_noticed(tmp_path):
    path = tmp_path / "file"
    write_sealed(path, random.Random(1).randbytes(4 * PAGE), identity=bytes(16), sync=False)
    data = path.read_bytes()
    path.write_bytes(data[PAGE : 2 * PAGE] + data[:PAGE] + data[2 * PAGE :])
    with closing(SealedFile(path)) as file:
        assert file.bad_pages() == [0, 1]
        file.seek(2 * PAGE)
        assert file.read() == data[2 * PAGE : 4 * PAGE]


def test_the_journal_of_another_file_is_left_alone(tmp_path, monkeypatch):
    path, other = tmp_path / "file", tmp_path / "other"
    for each in (path, other):
        with closing(SealedWriter.create(each)) as file:
            file.write(each.name.encode())
            file.commit(sync=True)
            if each == other:
                file.write(b" more")
                monkeypatch.setattr(sealed_writer, "_write_all", killed)
                with pytest.raises(KilledError):
                    file.commit(sync=True)
    journal_path(other).rename(journal_path(path))
    assert content(path) == b"file"


def killed(*_):
    raise KilledError


def test_only_one_may_write(tmp_path):
    path = tmp_path / "file"
    with closing(SealedWriter.create(path)):
        for open_it in (SealedWriter, SealedWriter.create):
            with pytest.raises(CaseError, match="another process has it open"):
                open_it(path)
    SealedWriter(path).close()


def test_a_reader_is_told_when_the_file_has_gone_on(tmp_path):
    path = tmp_path / "file"
    with closing(SealedWriter.create(path)) as writer:
        writer.write(bytes(2 * PAGE))
        writer.commit(sync=True)
        with closing(SealedFile(path)) as reader:
            writer.seek(0)
            writer.write(b"new")
            writer.commit(sync=True)
            with pytest.raises(DamagedError, match="since the file was opened; open it again"):
                reader.read()


def test_a_damaged_journal_is_noticed(tmp_path):
    path = tmp_path / "file"
    with closing(SealedWriter.create(path)) as file:
        file.write(b"first")
        file.commit(sync=True)
        file.seek(0)
        file.write(b"other")
        file.commit(sync=False)
    assert content(path) == b"other"
    journal = bytearray(journal_path(path).read_bytes())
    journal[100] ^= 1
    journal_path(path).write_bytes(journal)
    with pytest.warns(TriboWarning, match="its journal is damaged"):
        assert content(path) == b"first"


def test_a_journal_older_than_the_file_is_not_read(tmp_path):
    path = tmp_path / "file"
    with closing(SealedWriter.create(path)) as file:
        file.write(b"first")
        file.commit(sync=False)
        old = journal_path(path).read_bytes()
        file.seek(0)
        file.write(b"other")
        file.commit(sync=True)
    journal_path(path).write_bytes(old)
    assert content(path) == b"other"


def test_what_another_process_is_writing_keeps_its_checkpoint(tmp_path):
    path = tmp_path / "run.h5"
    checkpoint_path(path).write_bytes(b"of the other process")
    with (
        closing(SealedWriter.create(path)),
        pytest.raises(CaseError, match="in use"),
    ):
        Simulation(case()).run(path, overwrite=True)
    assert checkpoint_path(path).exists()


def test_a_journal_begun_while_the_file_is_opened_is_read(tmp_path, monkeypatch):
    path = tmp_path / "file"
    with closing(SealedWriter.create(path)) as file:
        file.write(b"first")
        file.commit(sync=False)
    # The writer is in the middle of the seal.
    path.write_bytes(path.read_bytes()[:-1])
    answers = iter([None, sealed_file.read_journal(path)])
    monkeypatch.setattr(sealed_file, "read_journal", lambda _: next(answers))
    assert content(path) == b"first"


def test_a_file_system_without_locks_is_told_of_once(tmp_path, monkeypatch):
    def flock(*_):
        raise OSError(errno.ENOLCK, "No locks available")

    monkeypatch.setattr(locks.fcntl, "flock", flock)
    path = tmp_path / "run.h5"
    path.write_bytes(b"an older one")
    with pytest.warns(TriboWarning, match=r"run\.h5: its file system has no locks") as told:
        Simulation(case(kinematics=motion(duration=1))).run(path, overwrite=True).close()
    assert len([each for each in told if "locks" in str(each.message)]) == 1


def test_a_journal_that_counts_more_pages_than_it_has_is_refused(tmp_path):
    path = tmp_path / "file"
    with closing(SealedWriter.create(path)) as file:
        file.write(b"first")
        file.commit(sync=True)
        file.write(b"more")
        file.commit(sync=False)
    journal = journal_path(path)
    data = journal.read_bytes()
    body = data[:8] + struct.pack("<Q", 2**40) + data[16:-32]
    journal.write_bytes(body + sha256(body).digest())
    with pytest.warns(TriboWarning, match="not one of tribo's"):
        assert content(path) == b"first"
