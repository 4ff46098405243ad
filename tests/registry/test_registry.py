"""Names in a case resolve to classes; a bad plugin is a record, not a crash."""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib import metadata
from types import ModuleType, SimpleNamespace
from typing import Any, Literal

import pytest

from tribo.core.errors import CaseError
from tribo.interfaces.observer import Observer, ObserverConfig
from tribo.interfaces.surface import Surface, SurfaceConfig
from tribo.registry import loader
from tribo.registry.builtin import __name__ as builtin_module
from tribo.registry.hookspecs import hookimpl
from tribo.registry.loader import given
from tribo.registry.registry import Registry, default_registry


class QuietConfig(ObserverConfig):
    type: Literal["quiet"] = "quiet"


class Quiet(Observer[QuietConfig]):
    Config = QuietConfig


class AlsoQuiet(Observer[QuietConfig]):
    Config = QuietConfig


class LoudConfig(ObserverConfig):
    type: Literal["loud"] = "loud"


class Loud(Observer[LoudConfig]):
    Config = LoudConfig


def plugin(name: str, **hooks: Callable[[], Any]) -> ModuleType:
    module = ModuleType(name)
    for hook, function in hooks.items():
        setattr(module, hook, hookimpl(specname=hook)(function))
    return module


GOOD = plugin("good", tribo_observers=lambda: [Quiet])


def only(*plugins: object) -> Registry:
    return Registry([given(p) for p in plugins])


def test_a_name_resolves_to_its_class_and_its_provider() -> None:
    registry = only(GOOD)
    assert registry.lookup("observer", "quiet") is Quiet
    assert registry.names("observer") == ["quiet"]
    assert registry.classes("observer") == [Quiet]
    assert registry.record("observer", "quiet").plugin.distribution == "good"
    assert [(p.status, p.reason) for p in registry.plugins] == [("loaded", "")]


def test_a_name_belongs_to_its_kind() -> None:
    with pytest.raises(CaseError, match="unknown surface 'quiet'"):
        only(GOOD).lookup("surface", "quiet")


def test_an_unknown_name_suggests_one_and_says_who_provides_what() -> None:
    versioned = plugin("acme", tribo_observers=lambda: [Loud])
    versioned.__version__ = "1.2"  # type: ignore[attr-defined]
    with pytest.raises(CaseError) as caught:
        only(GOOD, versioned).lookup("observer", "quite")
    assert str(caught.value) == (
        "unknown observer 'quite'; did you mean 'quiet'? Installed: loud (acme 1.2); quiet (good)"
    )


def raises(error: BaseException) -> Callable[[], Any]:
    def hook() -> Any:
        raise error

    return hook


class Bare(Surface[SurfaceConfig]):
    pass


class NamelessConfig(ObserverConfig):
    pass


class Nameless(Observer[NamelessConfig]):
    Config = NamelessConfig


class Unconfigured(Observer[QuietConfig]):
    pass


@pytest.mark.parametrize(
    ("bad", "reason"),
    [
        (plugin("bad", tribo_observers=raises(RuntimeError("no licence"))), "no licence"),
        (plugin("bad", tribo_observers=raises(SystemExit(3))), "SystemExit: 3"),
        (plugin("bad", tribo_observer=lambda: [Loud]), "unknown hook 'tribo_observer'"),
        (plugin("bad", tribo_observers=lambda: None), "TypeError"),
        (plugin("bad", tribo_observers=lambda: [Bare]), "Bare, not a subclass of tribo.interf"),
        (plugin("bad", tribo_observers=lambda: [Quiet(QuietConfig())]), "not a subclass of"),
        (plugin("bad", tribo_surfaces=lambda: [Bare]), "Bare does not define height"),
        (plugin("bad", tribo_observers=lambda: [Unconfigured]), "Config is not a subclass of"),
        (plugin("bad", tribo_observers=lambda: [Nameless]), "NamelessConfig needs a line: type"),
        (plugin("bad", tribo_observers=lambda: [Quiet, AlsoQuiet]), "returns 'quiet' twice"),
        (plugin("bad", tribo_observers=lambda x: [Quiet]), "PluginValidationError"),  # type: ignore[misc,arg-type]
    ],
)
def test_a_bad_plugin_is_recorded_and_leaves_the_others_alone(bad: ModuleType, reason: str) -> None:
    registry = only(bad, GOOD)
    record, good = registry.plugins
    assert (record.distribution, record.status) == ("bad", "broken")
    assert reason in record.reason
    assert "\n" not in record.reason
    assert good.status == "loaded"
    assert registry.names("observer") == ["quiet"]
    with pytest.raises(CaseError, match="bad is broken: "):
        registry.lookup("observer", "loud")


def test_a_name_claimed_twice_is_unusable_and_both_are_named() -> None:
    other = plugin("other", tribo_observers=lambda: [AlsoQuiet, Loud])
    registry = only(GOOD, other)
    with pytest.raises(CaseError, match="'quiet' is offered by good and other"):
        registry.lookup("observer", "quiet")
    assert registry.names("observer") == ["loud"]
    assert [(p.status, p.reason) for p in registry.plugins] == [
        ("conflict", "observer 'quiet' also from other"),
        ("conflict", "observer 'quiet' also from good"),
    ]


def entry_point(distribution: str, version: str, name: str, value: str) -> Any:
    dist = SimpleNamespace(name=distribution, version=version)
    point = metadata.EntryPoint(name, value, loader.GROUP)
    vars(point)["dist"] = dist
    return point


def test_entry_points_are_loaded_whatever_they_raise(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "acme_observers", GOOD)
    points = [
        # The same entry-point name in two distributions is no conflict.
        entry_point("acme-tribo", "1.2", "plugin", "acme_observers"),
        entry_point("gone-tribo", "0.1", "plugin", "no_such_module_anywhere"),
        entry_point("odd-tribo", "0.1", "plugin", "acme_observers:no_such_attribute"),
    ]
    monkeypatch.setattr(metadata, "entry_points", lambda group: points)
    registry = Registry(loader.installed())
    assert [(str(p), p.status, p.origin) for p in registry.plugins] == [
        ("acme-tribo 1.2", "loaded", "installed"),
        ("gone-tribo 0.1", "broken", "installed"),
        ("odd-tribo 0.1", "broken", "installed"),
    ]
    assert "no_such_module_anywhere" in registry.plugins[1].reason
    assert registry.record("observer", "quiet").plugin.entry_point == "plugin = acme_observers"


def test_finding_plugins_imports_none_of_them(monkeypatch: pytest.MonkeyPatch) -> None:
    point = entry_point("gone-tribo", "0.1", "plugin", "no_such_module_anywhere")
    monkeypatch.setattr(metadata, "entry_points", lambda group: [point])
    (source,) = loader.installed()
    with pytest.raises(ModuleNotFoundError):
        source.load()


def test_the_built_in_components_come_through_the_same_hooks() -> None:
    registry = Registry.with_plugins(GOOD)
    assert [(p.origin, p.status, p.reason) for p in registry.plugins] == [
        ("built-in", "loaded", ""),
        ("given", "loaded", ""),
    ]
    assert registry.plugins[0].entry_point == builtin_module
    assert {kind: registry.names(kind) for kind in ("contact_solver", "wear_law", "surface")} == {
        "contact_solver": ["dcfft", "winkler"],
        "wear_law": ["archard", "power"],
        "surface": ["cylinder", "flat", "paraboloid", "sphere"],
    }
    assert "quiet" in registry.names("observer")


def test_the_default_registry_is_loaded_once() -> None:
    assert default_registry() is default_registry()
