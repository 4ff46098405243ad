"""A plugin that was shown to import is not tried again until it changes."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from fake_distributions import distribute, observer, sources

from tribo.registry import registry as registry_module
from tribo.registry.loader import Source
from tribo.registry.probe import probe
from tribo.registry.registry import Registry

CODE = observer("kept.calm")


def put(folder: Path, code: str = CODE, version: str = "1.0") -> None:
    for old in folder.glob("kept_tribo-*.dist-info/*"):
        old.unlink()
        if not any(old.parent.iterdir()):
            old.parent.rmdir()
    points = {"tribo.v1.observer": {"kept.calm": "kept.plugin"}}
    distribute(folder, "kept-tribo", version, points)
    (folder / "kept").mkdir(exist_ok=True)
    (folder / "kept" / "plugin.py").write_text(code)


@pytest.fixture
def tries(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[], int]:
    """Looks the plugin's name up in a new registry, and returns how often it was tried by then."""
    put(folder)
    probed = []

    def counted(source: Source) -> Source:
        probed.append(source)
        return probe(source)

    monkeypatch.setattr(registry_module, "probe", counted)

    def look_up() -> int:
        for module in [name for name in sys.modules if name.split(".")[0] == "kept"]:
            del sys.modules[module]
        registry = Registry(sources("kept-tribo"))
        assert registry.lookup("observer", "kept.calm").__module__ == "kept.plugin"
        return len(probed)

    return look_up


def test_it_is_tried_once(tries: Callable[[], int]) -> None:
    assert [tries(), tries(), tries()] == [1, 1, 1]


@pytest.mark.parametrize(
    "change",
    [
        lambda folder: put(folder, CODE + "# edited\n"),
        lambda folder: put(folder, version="1.1"),
        lambda folder: (folder / "kept" / "more.py").write_text(""),
        lambda folder: (folder / "kept" / "native.so").write_bytes(b""),
    ],
)
def test_it_is_tried_again_when_it_has_changed(
    tries: Callable[[], int], folder: Path, change: Callable[[Path], Any]
) -> None:
    assert tries() == 1
    change(folder)
    assert [tries(), tries()] == [2, 2]


def test_what_is_broken_is_not_kept(tries: Callable[[], int], folder: Path, cache: Path) -> None:
    assert tries() == 1
    (source,) = sources("kept-tribo")
    put(folder, "1/0")
    assert probe(source).record.status == "broken"
    assert json.loads((cache / "tribo" / "plugins.json").read_text()) == {}


@pytest.mark.parametrize("text", ["", "no JSON", "[]", "[1]", "null", '{"a": {}}', "\0\xff"])
def test_a_cache_that_cannot_be_read_is_begun_anew(
    tries: Callable[[], int], cache: Path, text: str
) -> None:
    (cache / "tribo").mkdir()
    (cache / "tribo" / "plugins.json").write_text(text, encoding="latin-1")
    assert [tries(), tries()] == [1, 1]


def test_a_cache_that_cannot_be_written_is_done_without(
    tries: Callable[[], int], cache: Path
) -> None:
    (cache / "tribo").write_text("not a folder")
    assert [tries(), tries()] == [1, 2]


def test_a_relative_place_for_caches_is_not_taken(
    tries: Callable[[], int], cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(cache)
    monkeypatch.setenv("HOME", str(cache / "home"))
    monkeypatch.setenv("XDG_CACHE_HOME", "here")
    assert tries() == 1
    assert [path.name for path in cache.iterdir()] == ["home"]
    assert (cache / "home" / ".cache" / "tribo" / "plugins.json").is_file()
