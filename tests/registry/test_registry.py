"""Names in a case resolve to classes, each of the plugin that declares it."""

from __future__ import annotations

import sys
import warnings
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from fake_distributions import distribute, observer, plugins

from tribo.core.errors import CaseError
from tribo.observers.observer import Observer
from tribo.registry.catalogue import catalogue
from tribo.registry.hookspecs import hookimpl
from tribo.registry.plugins import builtin
from tribo.registry.registry import Registry
from tribo.registry.selection import selected
from tribo.surfaces.surface import Surface


class Quiet(Observer):
    type = "quiet"


class AlsoQuiet(Observer):
    type = "quiet"


class Loud(Observer):
    type = "loud"


class Bare(Surface):
    pass


def plugin(name: str, *classes: Any, hook: str = "tribo_components", **options: bool) -> ModuleType:
    module = ModuleType(name)
    setattr(module, hook, hookimpl(specname=hook, **options)(lambda: classes))
    return module


GOOD = plugin("good", Quiet)


def found(*distributions: str) -> Registry:
    return Registry(selected(plugins(*distributions)))


def test_a_name_resolves_to_its_class_and_its_provider() -> None:
    registry = Registry.with_plugins(GOOD)
    assert registry.lookup("observer", "quiet") is Quiet
    assert "quiet" in registry.names("observer")
    assert [str(plugin) for plugin in registry.claimants("quiet")] == ["good"]


def test_a_name_belongs_to_the_kind_of_its_class() -> None:
    registry = Registry.with_plugins(GOOD)
    with pytest.raises(CaseError, match="unknown surface 'quiet': it is an observer"):
        registry.lookup("surface", "quiet")


def test_an_unknown_name_suggests_one_and_says_who_provides_what() -> None:
    versioned = plugin("acme", Loud)
    versioned.__version__ = "1.2"  # type: ignore[attr-defined]
    with pytest.raises(
        CaseError, match=r"did you mean 'quiet'\?.* loud \(acme 1\.2\).* quiet \(good\)"
    ):
        Registry.with_plugins(GOOD, versioned).lookup("observer", "quite")


@pytest.mark.parametrize(
    ("bad", "reason"),
    [
        (plugin("bad", Quiet()), "is not a class"),
        (plugin("bad", Bare), "Bare does not define height"),
        (plugin("bad", Quiet, AlsoQuiet), "returns 'quiet' twice"),
    ],
)
def test_a_given_plugin_must_keep_the_contract(bad: ModuleType, reason: str) -> None:
    with pytest.raises((TypeError, ValueError), match=reason):
        Registry.with_plugins(bad)


def test_a_hook_of_another_version_may_be_optional() -> None:
    later = plugin("later", hook="tribo_lubricants", optionalhook=True)
    assert Registry.with_plugins(later).plugins[1].status == "loaded"


def test_a_plugin_is_imported_when_one_of_its_names_is_looked_up(folder: Path) -> None:
    code = observer("pair.one") + observer("pair.two").replace("[Two]", "[One, Two]")
    distribute(folder, "pair", "1.0", {"pair.two": "pair", "pair.one": "pair"}, pair=code)
    registry = found("pair")
    assert registry.waiting == ["pair.one", "pair.two"]
    assert [(str(p), p.status) for p in registry.plugins] == [("pair 1.0", "available")]
    assert "pair" not in sys.modules
    for name in ("pair.one", "pair.two"):
        assert registry.lookup("observer", name).type == name
    assert registry.names("observer") == ["pair.one", "pair.two"]
    assert [p.status for p in registry.plugins] == ["loaded"]


def test_what_is_meant_may_be_in_a_plugin_not_imported_yet(folder: Path) -> None:
    distribute(folder, "far", "1.0", {"far.calm": "far_calm"}, far_calm="1/0")
    with pytest.raises(CaseError, match=r"did you mean 'far\.calm'\?.*not imported yet: far\.calm"):
        found("far").lookup("observer", "far.clam")


BROKEN = {
    "import error": ("import no_such_module_anywhere", "ModuleNotFoundError"),
    "exit": ("raise SystemExit(3)", "SystemExit: 3"),
    "odd exception": (
        "class Odd(BaseException):\n    def __str__(self): raise ValueError\nraise Odd",
        "Odd",
    ),
    "hook typo": (observer("two.calm").replace("tribo_comp", "tribo_com"), "tribo_com"),
    "hook without a mark": (observer("two.calm").replace("@hookimpl", ""), "marked with @hookimpl"),
    "hook with an argument": (
        observer("two.calm").replace("components()", "components(x)"),
        "PluginValidationError",
    ),
    "hook that raises": (observer("two.calm").replace("return [", "return 1 / 0, ["), "division"),
    "hook that returns nothing": (
        observer("two.calm").replace("return [Calm]", "return None"),
        "returns nothing",
    ),
    "no hook": ("", "returns nothing"),
    "another name": (observer("two.clam"), "returns two.clam"),
    "wrong class": (observer("two.calm").replace("return [Calm]", "return [dict]"), "dict must be"),
}


@pytest.mark.parametrize("fault", BROKEN)
def test_a_broken_plugin_is_fatal_only_where_it_is_named(folder: Path, fault: str) -> None:
    code, reason = BROKEN[fault]
    distribute(folder, "two-tribo", "0.1", {"two.calm": "two_calm"}, two_calm=code)
    registry = Registry([builtin(), *plugins("two-tribo")])
    for _ in range(2):
        with pytest.raises(
            CaseError, match=r"'two\.calm' cannot be used: two-tribo 0\.1 is broken"
        ):
            registry.lookup("observer", "two.calm")
    assert registry.plugins[1].status == "broken"
    assert reason in registry.plugins[1].reason
    assert "\n" not in registry.plugins[1].reason
    assert registry.lookup("wear_law", "archard").type == "archard"


@pytest.mark.parametrize(
    ("name", "code", "line"),
    [
        ("at_once", "\n\nimport no_such_module_anywhere\n", 3),
        ("in_numpy", "import numpy\ndef wrong():\n    numpy.load('no.npy')\n\nwrong()", 3),
        ("syntax", "x = 1\ny = = 2\n", 2),
        ("in_hook", observer("lost.calm").replace("return [", "return 1 / 0, ["), 9),
    ],
)
def test_a_failed_import_shows_the_author_s_file_and_line(
    folder: Path, name: str, code: str, line: int
) -> None:
    distribute(folder, name, "0.1", {"lost.calm": name}, **{name: code})
    with pytest.raises(CaseError) as caught:
        found(name).lookup("observer", "lost.calm")
    assert f"({folder / f'{name}.py'}, line {line})" in str(caught.value)


@pytest.mark.parametrize(
    ("requires", "told"),
    [
        ("tribo<0.0.1", "it requires tribo<0.0.1, but tribo is installed in version "),
        ("no-such-thing>=2", "it requires no-such-thing>=2, but no-such-thing is not installed"),
    ],
)
def test_a_plugin_whose_requirements_do_not_hold_is_not_used(
    folder: Path, requires: str, told: str
) -> None:
    code = {"needy": observer("needy.calm")}
    distribute(folder, "needy", "1", {"needy.calm": "needy"}, [requires], **code)
    registry = found("needy")
    (row,) = (row for row in catalogue(registry) if row["name"] == "needy.calm")
    assert (row["status"], told in row["reason"]) == ("incompatible", True)
    with pytest.raises(CaseError, match=r"'needy\.calm' cannot be used: needy 1 is incompatible"):
        registry.lookup("observer", "needy.calm")
    assert told in registry.plugins[0].reason
    assert "needy" not in sys.modules


@pytest.mark.parametrize(
    "requires", ["tribo>=0.0.1", "numpy", "no-such; extra == 'x'", "no-such; python_version < '3'"]
)
def test_a_requirement_that_holds_or_is_none_here_is_no_matter(folder: Path, requires: str) -> None:
    code = observer("glad.calm")
    distribute(folder, "glad", "1", {"glad.calm": "glad"}, [requires], glad=code)
    assert found("glad").lookup("observer", "glad.calm").type == "glad.calm"


def test_a_name_without_a_prefix_is_tribo_s(folder: Path) -> None:
    distribute(folder, "bare", "1.0", {"archard": "bare_law"}, bare_law="1/0")
    registry = Registry([builtin(), *plugins("bare")])
    assert registry.lookup("wear_law", "archard").__module__ == "tribo.wear.archard"
    assert "'archard' needs a prefix" in registry.plugins[1].reason


def test_two_distributions_that_claim_a_name_lose_it_unless_one_is_turned_off(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("four-c", "four-d"):
        module = name.replace("-", "_")
        own = f"{module}.loud"
        code = observer("four.quiet") + observer(own).replace("[Loud]", "[Quiet, Loud]")
        points = {"four.quiet": module, own: module}
        distribute(folder, name, "1.0", points, **{module: code})
    registry = found("four-c", "four-d")
    assert registry.waiting == ["four_c.loud", "four_d.loud"]
    with pytest.raises(CaseError, match=r"'four.quiet' is offered by four-c 1\.0 and four-d 1\.0"):
        registry.lookup("observer", "four.quiet")
    assert registry.lookup("observer", "four_c.loud").__module__ == "four_c"
    monkeypatch.setenv("TRIBO_DISABLE_PLUGINS", "four-c")
    settled = found("four-c", "four-d")
    assert settled.lookup("observer", "four.quiet").__module__ == "four_d"


def test_a_folder_that_is_searched_twice_holds_its_plugins_once(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    distribute(folder, "twice", "1.0", {"twice.calm": "twice"}, twice=observer("twice.calm"))
    monkeypatch.setattr("sys.path", [*sys.path, str(folder)])
    assert len(plugins("twice")) == 1


def test_what_a_plugin_prints_does_not_reach_stdout(
    folder: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    code = observer("ten.calm").replace("    return", "    print('from the hook')\n    return")
    code = "print('from the import')\n" + code
    distribute(folder, "ten-tribo", "1.0", {"ten.calm": "ten_calm"}, ten_calm=code)
    found("ten-tribo").lookup("observer", "ten.calm")
    assert capfd.readouterr() == ("", "from the import\nfrom the hook\n")


def test_an_import_leaves_folder_warnings_and_numpy_as_they_were(folder: Path) -> None:
    code = (
        "import os, warnings\nimport numpy as np\nos.chdir('/')\n"
        "warnings.filterwarnings('ignore')\nnp.seterr(all='raise')\n"
    )
    distribute(folder, "moves", "1", {"moves.calm": "moves"}, moves=code + observer("moves.calm"))
    before = Path.cwd(), list(warnings.filters), np.geterr()
    assert found("moves").lookup("observer", "moves.calm").type == "moves.calm"
    assert (Path.cwd(), list(warnings.filters), np.geterr()) == before


EFFECT = """
from tribo import Effect, Field, hookimpl

class Warm(Effect):
    type = "{name}"
    provides = (Field("warmth", "K", "How warm."),)

    def fields(self, conditions): ...

@hookimpl
def tribo_components():
    return [Warm]
"""


def test_who_provides_a_field_is_known_of_what_is_imported(folder: Path) -> None:
    for name in ("warm_a", "warm_b"):
        code = EFFECT.format(name=f"{name}.warm")
        distribute(folder, name, "1.0", {f"{name}.warm": name}, **{name: code})
    registry = found("warm_a", "warm_b")
    assert registry.providers(["warmth"]) == []
    registry.lookup("effect", "warm_b.warm")
    assert registry.providers(["warmth"]) == ["'warm_b.warm' (warm_b 1.0)"]
    assert "warm_a" not in sys.modules


@pytest.mark.parametrize("off", ["five-tribo", "Five_Tribo", "five", "five.calm", "*"])
def test_plugins_can_be_turned_off(folder: Path, monkeypatch: pytest.MonkeyPatch, off: str) -> None:
    distribute(folder, "five-tribo", "1.0", {"five.calm": "five_calm"}, five_calm="1/0")
    monkeypatch.setenv("TRIBO_DISABLE_PLUGINS", f" {off}, ")
    registry = found("five-tribo")
    assert [p.status for p in registry.plugins] == ["disabled"]
    with pytest.raises(CaseError, match=r"five-tribo 1\.0 is disabled: turned off"):
        registry.lookup("observer", "five.calm")


def test_only_some_plugins_can_be_kept(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("six-a", "six-b"):
        distribute(folder, name, "1.0", {f"{name.replace('-', '_')}.calm": "six"})
    monkeypatch.setenv("TRIBO_PLUGINS", "six-b")
    assert [p.status for p in found("six-a", "six-b").plugins] == ["disabled", "available"]


def test_the_built_in_components_come_through_the_same_hook() -> None:
    registry = Registry.with_plugins(GOOD)
    assert [(p.origin, p.status, p.reason) for p in registry.plugins] == [
        ("built-in", "loaded", ""),
        ("given", "loaded", ""),
    ]
    assert {kind: registry.names(kind) for kind in ("contact_solver", "wear_law", "surface")} == {
        "contact_solver": ["dcfft", "periodic", "winkler"],
        "wear_law": ["archard", "power"],
        "surface": ["cylinder", "flat", "paraboloid", "sphere"],
    }
