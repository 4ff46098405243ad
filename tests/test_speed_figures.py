"""A build of the docs refuses figures on speed that are older than so many changes of the code."""

import json
import subprocess
from importlib import import_module
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


@pytest.fixture
def speed(monkeypatch):
    monkeypatch.setenv("TRIBO_REPOSITORY", str(ROOT))
    monkeypatch.syspath_prepend(ROOT / "docs" / "support")
    return import_module("speed")


def git(folder, *words):
    known = ["-c", "user.name=x", "-c", "user.email=x@example.org"]
    command = ["git", "-C", str(folder), *known, *words]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()


@pytest.fixture
def repository(tmp_path):
    """Return a repository whose figures name its first commit."""
    git(tmp_path, "init", "-q")
    change(tmp_path, "tribo/contact/solver.py", 1)
    figures = {"hour": {"machine": {"commit": git(tmp_path, "rev-parse", "--short=10", "HEAD")}}}
    path = tmp_path / "docs" / "_data" / "speed.json"
    path.parent.mkdir(parents=True)
    path.write_text(json.dumps(figures))
    return tmp_path


def change(folder, name, times):
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    for _ in range(times):
        with path.open("a") as file:
            file.write("pass\n")
        git(folder, "add", name)
        git(folder, "commit", "-q", "-m", "x")


def test_figures_are_outdated_after_more_commits_than_allowed(speed, repository, monkeypatch):
    monkeypatch.setattr(speed, "MOST_COMMITS", 3)
    change(repository, "tribo/contact/solver.py", 2)
    change(repository, "tribo/stepping/march.py", 1)
    change(repository, "tribo/cli/run.py", 5)
    assert speed.outdated(repository) is None
    change(repository, "tribo/stepping/march.py", 1)
    message = speed.outdated(repository)
    assert "4 commits" in message
    assert "python -m benchmarks.speed.all hour" in message


def test_figures_are_shown_where_there_is_no_history(speed, repository, tmp_path_factory):
    change(repository, "tribo/contact/solver.py", speed.MOST_COMMITS + 1)
    assert speed.outdated(repository)
    unpacked = tmp_path_factory.mktemp("sdist")
    shallow = tmp_path_factory.mktemp("shallow")
    git(repository, "add", "docs")
    git(repository, "commit", "-q", "-m", "x")
    git(repository, "worktree", "add", "-q", str(unpacked / "tribo"))
    (unpacked / "tribo" / ".git").unlink()
    git(shallow, "clone", "-q", "--depth", "1", repository.as_uri(), "tribo")
    assert speed.outdated(unpacked / "tribo") is None
    assert speed.outdated(shallow / "tribo") is None
