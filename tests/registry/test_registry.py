"""Names in a case resolve to classes; a bad plugin is a record, not a crash."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from fake_distributions import distribute, observer, sources

from tribo.core.errors import CaseError
from tribo.interfaces.observer import Observer
from tribo.interfaces.surface import Surface
from tribo.registry import loader
from tribo.registry.builtin import __name__ as builtin_module
from tribo.registry.hookspecs import hookimpl
from tribo.registry.loader import given
from tribo.registry.registry import Registry, default_registry
from tribo.registry.selection import selected


class Quiet(Observer):
    type = "quiet"


class AlsoQuiet(Observer):
    type = "quiet"


class Loud(Observer):
    type = "loud"


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


class Bare(Surface):
    pass


class Nameless(Observer):
    pass


class Unconfigured(Observer):
    pass


@pytest.mark.parametrize(
    ("bad", "reason"),
    [
        (plugin("bad", tribo_observers=raises(RuntimeError("no licence"))), "no licence"),
        (plugin("bad", tribo_observers=raises(SystemExit(3))), "SystemExit: 3"),
        (
            plugin("bad", tribo_observer=lambda: [Loud]),
            "unknown hook 'tribo_observer' (did you mean 'tribo_observers'?)",
        ),
        (plugin("bad", tribo_zzz=lambda: [Loud]), "(the hooks are tribo_contact_solvers, tribo_"),
        (plugin("bad", tribo_observers=lambda: None), "TypeError"),
        (
            plugin("bad", tribo_observers=lambda: [Bare]),
            "Bare, not a subclass of tribo.plugin.Observer",
        ),
        (plugin("bad", tribo_observers=lambda: [Quiet()]), "not a subclass of"),
        (plugin("bad", tribo_surfaces=lambda: [Bare]), "Bare does not define height"),
        (plugin("bad", tribo_observers=lambda: [Unconfigured]), "Config is not a subclass of"),
        (plugin("bad", tribo_observers=lambda: [Nameless]), "Nameless needs a line: type"),
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


def found(*distributions: str) -> Registry:
    return Registry(selected(sources(*distributions)))


def test_names_are_known_without_importing_and_looked_up_by_importing(folder: Path) -> None:
    distribute(
        folder,
        "one-tribo",
        "1.2",
        {"tribo.v1.observer": {"one.calm": "one_calm"}},
        one_calm=observer("one.calm"),
    )
    registry = found("one-tribo")
    assert registry.names("observer") == ["one.calm"]
    assert "one_calm" not in sys.modules
    assert [(str(p), p.status) for p in registry.plugins] == [("one-tribo 1.2", "available")]
    assert registry.lookup("observer", "one.calm").__module__ == "one_calm"
    assert [p.status for p in registry.plugins] == ["loaded"]


BROKEN = {
    "import error": ("import no_such_module_anywhere", "ModuleNotFoundError"),
    "exit": ("raise SystemExit(3)", "SystemExit: 3"),
    "odd exception": (
        "class Odd(BaseException):\n    def __str__(self): raise ValueError\nraise Odd",
        "Odd",
    ),
    "hook typo": (
        observer("two.calm").replace("tribo_observers", "tribo_observer"),
        "tribo_observer",
    ),
    "no hook": ("", "does not return it"),
    "another name": (observer("two.clam"), "does not return it"),
    "wrong class": (
        observer("two.calm").replace("return [Calm]", "return [dict]"),
        "not a subclass of",
    ),
}


@pytest.mark.parametrize("fault", list(BROKEN))
def test_a_broken_plugin_is_fatal_only_where_it_is_named(folder: Path, fault: str) -> None:
    code, reason = BROKEN[fault]
    module = "two_" + fault.replace(" ", "_")
    points = {"tribo.v1.observer": {"two.calm": module}}
    distribute(folder, "two-tribo", "0.1", points, **{module: code})
    registry = Registry([loader.builtin(), *sources("two-tribo")])
    assert registry.lookup("wear_law", "archard").type_name() == "archard"
    with pytest.raises(
        CaseError, match=r"'two\.calm' is in two-tribo 0\.1, which is broken"
    ) as caught:
        registry.lookup("observer", "two.calm")
    assert reason in str(caught.value)
    assert "reinstall two-tribo" in str(caught.value)
    assert registry.plugins[1].status == "broken"


@pytest.mark.parametrize(
    ("group", "name", "status", "reason"),
    [
        ("tribo.v2.observer", "three.calm", "incompatible", "interface version 2"),
        (
            "tribo.v1.observre",
            "three.calm",
            "broken",
            "use one of tribo.v1.contact_solver",
        ),
        ("tribo.v1", "three.calm", "broken", "is unknown"),
        ("tribo.v1.observer", "calm", "broken", "needs a prefix"),
        ("tribo.v1.observer", "tribo.calm", "broken", "prefix 'tribo', which is tribo's own"),
    ],
)
def test_what_is_wrong_at_first_sight_is_not_imported(
    folder: Path, group: str, name: str, status: str, reason: str
) -> None:
    distribute(folder, "three-tribo", "1.0", {group: {name: "three_calm"}}, three_calm="1/0")
    (record,) = found("three-tribo").plugins
    assert record.status == status
    assert reason in record.reason


def test_two_distributions_that_claim_a_name_lose_it(folder: Path) -> None:
    for name in ("four-a", "four-b"):
        module = name.replace("-", "_")
        points = {"tribo.v1.observer": {"four.calm": module}}
        distribute(folder, name, "1.0", points, **{module: observer("four.calm")})
    registry = found("four-a", "four-b")
    assert [p.status for p in registry.plugins] == ["conflict", "conflict"]
    assert registry.names("observer") == []
    with pytest.raises(CaseError, match=r"offered by four-a 1\.0 and four-b 1\.0"):
        registry.lookup("observer", "four.calm")


def test_a_folder_that_is_searched_twice_holds_its_plugins_once(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    code = {"twice": observer("twice.calm")}
    distribute(folder, "twice", "1.0", {"tribo.v1.observer": {"twice.calm": "twice"}}, **code)
    monkeypatch.setattr("sys.path", [*sys.path, str(folder)])
    assert len(sources("twice")) == 1


def test_only_the_name_that_two_claim_is_lost(folder: Path) -> None:
    for name in ("four-c", "four-d"):
        module = name.replace("-", "_")
        own = f"{module}.loud"
        code = observer("four.quiet") + observer(own).replace(
            "return [Loud]", "return [Quiet, Loud]"
        )
        points = {"tribo.v1.observer": {"four.quiet": module, own: module}}
        distribute(folder, name, "1.0", points, **{module: code})
    registry = found("four-c", "four-d")
    assert registry.names("observer") == ["four_c.loud", "four_d.loud"]
    assert registry.lookup("observer", "four_c.loud").__module__ == "four_c"
    # What is known of a plugin once it is imported includes the conflict.
    assert [(p.status, p.reason) for p in registry.plugins] == [
        ("conflict", "observer 'four.quiet' also from four-d 1.0"),
        ("conflict", "observer 'four.quiet' also from four-c 1.0"),
    ]


def test_what_supports_two_versions_of_the_interfaces_is_used_in_the_one_of_now(
    folder: Path,
) -> None:
    both = {
        "tribo.v1.observer": {"eight.calm": "eight_now"},
        "tribo.v2.observer": {"eight.calm": "eight_now", "eight.more": "eight_then"},
    }
    distribute(folder, "eight-tribo", "1.0", both, eight_now=observer("eight.calm"))
    registry = found("eight-tribo")
    assert [(p.entry_point, p.status) for p in registry.plugins] == [("eight_now", "available")]
    assert registry.lookup("observer", "eight.calm").__module__ == "eight_now"


def test_a_plugin_for_other_versions_only_says_for_which(folder: Path) -> None:
    points = {f"tribo.v{api}.observer": {"nine.calm": "nine_calm"} for api in (2, 3)}
    distribute(folder, "nine-tribo", "1.0", points, nine_calm="1/0")
    (record,) = found("nine-tribo").plugins
    assert record.status == "incompatible"
    assert record.reason == (
        "made for interface version 2 and 3, this tribo has 1; install a newer tribo"
    )


def test_what_a_plugin_prints_does_not_reach_stdout(
    folder: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    code = observer("ten.calm").replace("    return", "    print('from the hook')\n    return")
    points = {"tribo.v1.observer": {"ten.calm": "ten_calm"}}
    distribute(folder, "ten-tribo", "1.0", points, ten_calm="print('from the import')" + code)
    found("ten-tribo").lookup("observer", "ten.calm")
    assert capfd.readouterr() == ("", "from the import\nfrom the hook\n")


def test_a_hook_that_is_not_marked_is_named(folder: Path) -> None:
    code = observer("eleven.calm").replace("@hookimpl", "")
    points = {"tribo.v1.observer": {"eleven.calm": "eleven_calm"}}
    distribute(folder, "eleven-tribo", "1.0", points, eleven_calm=code)
    with pytest.raises(CaseError, match=r"hook tribo_observers is not marked .* write @hookimpl"):
        found("eleven-tribo").lookup("observer", "eleven.calm")


def test_a_hook_of_another_version_may_be_optional() -> None:
    later = plugin("later", tribo_observers=lambda: [Quiet])
    later.tribo_lubricants = hookimpl(  # type: ignore[attr-defined]
        specname="tribo_lubricants", optionalhook=True
    )(lambda: [])
    assert only(later).names("observer") == ["quiet"]


EFFECT = """
from typing import Literal
from tribo.plugin import Effect, Field, hookimpl

class Warm(Effect):
    type = "{name}"

class Warm(Effect):
    provides = (Field("warmth", "K", "How warm."),)

    def fields(self, conditions): ...

@hookimpl
def tribo_effects():
    return [Warm]
"""


def test_who_provides_a_field_is_known_of_what_is_imported(folder: Path) -> None:
    for name in ("warm_a", "warm_b"):
        points = {"tribo.v1.effect": {f"{name}.warm": name}}
        distribute(folder, name, "1.0", points, **{name: EFFECT.format(name=f"{name}.warm")})
    registry = found("warm_a", "warm_b")
    assert registry.providers(["warmth"]) == []
    registry.lookup("effect", "warm_b.warm")
    assert registry.providers(["warmth"]) == ["'warm_b.warm' (warm_b 1.0)"]
    assert "warm_a" not in sys.modules


@pytest.mark.parametrize("off", ["five-tribo", "Five_Tribo", "five", "five.calm", "*"])
def test_plugins_can_be_turned_off(folder: Path, monkeypatch: pytest.MonkeyPatch, off: str) -> None:
    points = {"tribo.v1.observer": {"five.calm": "five_calm"}}
    distribute(folder, "five-tribo", "1.0", points, five_calm=observer("five.calm"))
    monkeypatch.setenv("TRIBO_DISABLE_PLUGINS", f" {off}, ")
    registry = found("five-tribo")
    assert [p.status for p in registry.plugins] == ["disabled"]
    with pytest.raises(CaseError, match=r"five-tribo 1\.0 is disabled: turned off"):
        registry.lookup("observer", "five.calm")


def test_only_some_plugins_can_be_kept(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("six-a", "six-b"):
        module = name.replace("-", "_")
        points = {"tribo.v1.observer": {f"{module}.calm": module}}
        distribute(folder, name, "1.0", points, **{module: observer(f"{module}.calm")})
    monkeypatch.setenv("TRIBO_PLUGINS", "six-b")
    assert [p.status for p in found("six-a", "six-b").plugins] == ["disabled", "available"]


def test_the_built_in_components_come_through_the_same_hooks() -> None:
    registry = Registry.with_plugins(GOOD)
    assert [(p.origin, p.status, p.reason) for p in registry.plugins] == [
        ("built-in", "loaded", ""),
        ("given", "loaded", ""),
    ]
    assert registry.plugins[0].entry_point == builtin_module
    assert {kind: registry.names(kind) for kind in ("contact_solver", "wear_law", "surface")} == {
        "contact_solver": ["dcfft", "periodic", "winkler"],
        "wear_law": ["archard", "power"],
        "surface": ["cylinder", "flat", "paraboloid", "sphere"],
    }
    assert "quiet" in registry.names("observer")


def test_the_default_registry_is_loaded_once() -> None:
    assert default_registry() is default_registry()
