"""The folder that a crash leaves before each file operation of a piece of work.

The operations of `tribo.core.writing` are recorded as the work is done, and done again on two
layers: what a program sees, and what the disk has. A file has its bytes on the disk once it is
synced, and its name once its folder is.
"""

import os
import re
import shutil
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from unittest import mock

from tribo.core import writing


@dataclass
class Crash:
    """What a crash leaves: bytes by path within the folder, None of a folder.

    It comes before operation `at`, after so many saves were acknowledged.
    """

    at: int
    how: str
    acknowledged: int
    files: dict
    before: tuple
    """What that operation does, and to which file in the end; parts of a result are all one."""

    def lay(self, folder):
        """Make the folder what the crash left."""
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        for name, held in sorted(self.files.items()):
            if held is None:
                (folder / name).mkdir()
            else:
                (folder / name).write_bytes(held)


@dataclass
class Recorded:
    """The operations of some work, in order, and what was in its folder before."""

    folder: Path
    before: dict
    operations: list = field(default_factory=list)

    def acknowledge(self, time=0.0):
        """Tell that the work has told of a save."""
        self.operations.append(("acknowledged",))

    def crashes(self):
        """Return every different crash, also that after the last operation."""
        seen, told, found = _Disk(self.before), 0, {}
        final = {each[1]: each[2] for each in self.operations if each[0] == "rename"}
        for at, operation in enumerate([*self.operations, ("end",)]):
            views = seen.crashed()
            if operation[0] == "write":
                path, held = operation[1:]
                views["torn"] = seen.view(seen.names, {**seen.held, seen.names[path]: held[::2]})
            kind, path = (*operation[:2], "")[:2]
            before = kind, re.sub(r"\d+", "", final.get(path, path))
            for how, files in views.items():
                found.setdefault(
                    (told, frozenset(files.items())), Crash(at, how, told, files, before)
                )
            told += operation[0] == "acknowledged"
            seen.do(*operation)
        return list(found.values())


def of_each_kind(crashes):
    """Return one of the crashes alike: before the same operation on a file, with saves or none."""
    alike = {(crash.how, crash.before, crash.acknowledged > 0): crash for crash in crashes}
    return list(alike.values())


class _Disk:
    """Names of files by path, bytes by file; `kept` and `synced` are those on the disk."""

    def __init__(self, files):
        self.names = {path: None if held is None else path for path, held in files.items()}
        self.held = {path: held for path, held in files.items() if held is not None}
        self.kept, self.synced = dict(self.names), dict(self.held)
        self._made = 0

    def do(self, kind, path="", other=None):
        if kind == "create":
            self._made += 1
            self.names[path], self.held[self._made] = self._made, b""
        elif kind == "write":
            self.held[self.names[path]] = other
        elif kind == "sync":
            self.synced[self.names[path]] = self.held[self.names[path]]
        elif kind == "rename":
            self.names[other] = self.names.pop(path)
        elif kind == "remove":
            del self.names[path]
        elif kind == "folder":
            self.names[path] = None
        elif kind == "sync names":
            inside = {p for p in {*self.names, *self.kept} if os.path.dirname(p) == path}
            for each in inside:
                self.kept.pop(each, None)
                if each in self.names:
                    self.kept[each] = self.names[each]

    def view(self, names, held):
        return {
            path: None if file is None else held.get(file, b"")
            for path, file in names.items()
            if os.path.dirname(path) in {"", *names}
        }

    def crashed(self):
        return {
            "killed": self.view(self.names, self.held),
            "bytes lost": self.view(self.names, self.synced),
            "names lost": self.view(self.kept, self.held),
            "both lost": self.view(self.kept, self.synced),
        }


class _Operations:
    """The module `os`, as `tribo.core.writing` sees it, with what it does recorded."""

    def __init__(self, recorded):
        self._recorded, self._opened = recorded, {}

    def __getattr__(self, name):
        done = getattr(os, name)
        if name not in KINDS:
            return done

        def noted(*paths):
            done(*paths)
            self._note(KINDS[name], *paths)

        return noted

    def _note(self, kind, path, other=None):
        folder = self._recorded.folder
        if Path(path).resolve().is_relative_to(folder):
            name = Path(path).resolve().relative_to(folder).as_posix()
            if kind == "rename":
                other = Path(other).resolve().relative_to(folder).as_posix()
            self._recorded.operations.append((kind, "" if name == "." else name, other))

    def open(self, path, flags, mode=0o777):
        fresh = not os.path.exists(path)
        opened = os.open(path, flags, mode)
        if fresh:
            self._note("create", path)
        self._opened[opened] = path
        return opened

    def fsync(self, opened):
        path = self._opened[opened]
        os.fsync(opened)
        if os.path.isdir(path):
            self._note("sync names", path)
        else:
            self._note("write", path, Path(path).read_bytes())
            self._note("sync", path)

    def mkdir(self, path, *given, **named):
        fresh = not os.path.isdir(path)
        MKDIR(path, *given, **named)
        if fresh:
            self._note("folder", path)


MKDIR = Path.mkdir
KINDS = {"replace": "rename", "unlink": "remove", "rmdir": "remove"}


@contextmanager
def recorded(folder):
    """Record the file operations of what is done in a folder."""
    folder = folder.resolve()
    found = Recorded(folder, contents_of(folder))
    seen = _Operations(found)
    with (
        mock.patch.object(writing, "os", seen),
        mock.patch.object(Path, "mkdir", lambda *given, **named: seen.mkdir(*given, **named)),
    ):
        yield found


def contents_of(folder):
    """Return the bytes of each file in a folder, None of a folder, by path."""
    return {
        str(path.relative_to(folder)): None if path.is_dir() else path.read_bytes()
        for path in folder.rglob("*")
    }
