"""Names in a case resolve to classes, each of the plugin that declares it."""

import sys
import warnings
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from fake_distributions import LAW, distribute, observer, plugins

from tribo import CaseError, Observer, Registry, Surface, hookimpl
from tribo.registry.plugins import builtin


class Quiet(Observer):
    type = "quiet"


class AlsoQuiet(Observer):
    type = "quiet"


class Loud(Observer):
    type = "loud"


class Bare(Surface):
    pass


def plugin(name, *classes, hook="tribo_components", **options):
    module = ModuleType(name)
    setattr(module, hook, hookimpl(specname=hook, **options)(lambda: classes))
    return module


GOOD = plugin("good", Quiet)


def found(*distributions):
    return Registry(plugins(*distributions))


def test_the_built_in_components_and_given_ones_come_through_the_same_hook():
    registry = Registry.with_plugins(GOOD)
    assert [(p.origin, p.status, p.reason) for p in registry.plugins] == [
        ("built-in", "loaded", ""),
        ("given", "loaded", ""),
    ]
    assert {"cylinder", "flat", "sphere"} <= set(registry.names("surface"))
    assert registry.lookup("observer", "quiet") is Quiet
    assert str(registry.owners["quiet"]) == "good"


def test_a_name_belongs_to_the_kind_of_its_class():
    with pytest.raises(CaseError, match="surface is needed, 'quiet' is of kind observer"):
        Registry.with_plugins(GOOD).lookup("surface", "quiet")


def test_an_unknown_name_suggests_one_and_lists_what_there_is():
    registry = Registry.with_plugins(GOOD, plugin("acme", Loud))
    with pytest.raises(CaseError, match=r"did you mean 'quiet'\? Installed: loud, .*quiet"):
        registry.lookup("observer", "quite")


def test_a_given_plugin_must_keep_the_contract():
    for bad in (Quiet(), Bare, dict):
        with pytest.raises(TypeError):
            Registry.with_plugins(plugin("bad", bad))
    with pytest.raises(ValueError, match="returns 'quiet' twice"):
        Registry.with_plugins(plugin("bad", Quiet, AlsoQuiet))
    with pytest.raises(ValueError, match="'quiet' is offered by good already"):
        Registry.with_plugins(GOOD, plugin("other", AlsoQuiet))


def test_a_hook_of_another_version_may_be_optional():
    later = plugin("later", hook="tribo_lubricants", optionalhook=True)
    assert Registry.with_plugins(later).plugins[1].status == "loaded"


def test_a_plugin_is_imported_when_one_of_its_names_is_looked_up(folder):
    code = observer("pair.one") + observer("pair.two").replace("[Two]", "[One, Two]")
    distribute(folder, "pair", "1.0", {"pair.two": "pair", "pair.one": "pair"}, pair=code)
    registry = found("pair")
    assert registry.waiting == ["pair.one", "pair.two"]
    assert [(str(p), p.status) for p in registry.plugins] == [("pair 1.0", "available")]
    with pytest.raises(CaseError, match=r"'pair\.one'\? Installed: none; more: tribo plugins l"):
        registry.lookup("observer", "pair.oen")
    assert "pair" not in sys.modules
    for name in ("pair.one", "pair.two"):
        assert registry.lookup("observer", name).type == name
    assert registry.names("observer") == ["pair.one", "pair.two"]
    assert [p.status for p in registry.plugins] == ["loaded"]


CALM = observer("two.calm")
HOT = LAW.format(name="two.calm")
ODD = "class Odd(BaseException):\n    def __str__(self): raise ValueError\nraise Odd"
BROKEN = {
    "import error": ("\nimport no_such_module_anywhere", "ModuleNotFoundError", 2),
    "deep error": ("import numpy\ndef f():\n    numpy.load('no.npy')\nf()", "FileNotFound", 3),
    "syntax error": ("x = 1\ny = = 2\n", "SyntaxError", 2),
    "odd exception": (ODD, "Odd", 3),
    "hook typo": (CALM.replace("tribo_comp", "tribo_com"), "unknown hook 'tribo_com", None),
    "hook without a mark": (CALM.replace("@hookimpl", ""), "marked with @hookimpl", None),
    "hook with an argument": (CALM.replace("nts()", "nts(x)"), "'tribo_components'", None),
    "hook that returns nothing": (CALM.replace("[Calm]", "None"), "returns nothing", None),
    "another name": (observer("two.clam"), "returns two.clam", None),
    "abstract": (HOT.replace("def rate", "def rates"), "no method rate; help(tribo.WearLaw)", None),
    "names as fields": (HOT.replace("requires = ()", "state_fields = ('a',)"), "of Field", 4),
}


@pytest.mark.parametrize("fault", BROKEN)
def test_a_broken_plugin_is_fatal_only_where_it_is_named_and_says_where(folder, fault):
    code, reason, line = BROKEN[fault]
    distribute(folder, "two-tribo", "0.1", {"two.calm": "two_calm"}, two_calm=code)
    registry = Registry([builtin(), *plugins("two-tribo")])
    for _ in range(2):
        with pytest.raises(
            CaseError, match=r"'two\.calm' cannot be used: two-tribo 0\.1 is broken"
        ):
            registry.lookup("observer", "two.calm")
    broken = registry.plugins[1]
    assert broken.status == "broken"
    assert reason in broken.reason
    assert "\n" not in broken.reason
    if line:
        assert f"({folder / 'two_calm.py'}, line {line})" in broken.reason
    assert registry.lookup("wear_law", "archard").type == "archard"


def test_a_name_without_a_prefix_is_tribo_s(folder):
    distribute(folder, "bare", "1.0", {"archard": "bare_law"}, bare_law="1/0")
    registry = Registry([builtin(), *plugins("bare")])
    assert registry.lookup("wear_law", "archard").__module__ == "tribo.wear.archard"
    assert "'archard' needs a prefix" in registry.plugins[1].reason


def test_two_distributions_that_claim_a_name_lose_it_unless_one_is_turned_off(folder, monkeypatch):
    for name in ("four_c", "four_d"):
        code = {name: observer("four.quiet")}
        distribute(folder, name, "1.0", {"four.quiet": name}, **code)
    registry = found("four_c", "four_d")
    assert [p.status for p in registry.plugins] == ["broken", "broken"]
    with pytest.raises(CaseError, match=r"four_d 1\.0 is broken: .* offers 'four.quiet' too"):
        registry.lookup("observer", "four.quiet")
    for variable, name in (("TRIBO_DISABLE_PLUGINS", "four_c"), ("TRIBO_PLUGINS", "four_d")):
        with monkeypatch.context() as chosen:
            chosen.setenv(variable, name)
            settled = found("four_c", "four_d")
        assert [p.status for p in settled.plugins] == ["disabled", "available"]
        assert settled.lookup("observer", "four.quiet").__module__ == "four_d"


def test_a_folder_that_is_searched_twice_holds_its_plugins_once(folder, monkeypatch):
    distribute(folder, "twice", "1.0", {"twice.calm": "twice"}, twice=observer("twice.calm"))
    monkeypatch.setattr("sys.path", [*sys.path, str(folder)])
    assert [plugin.names for plugin in plugins("twice")] == [("twice.calm",)]


MEDDLING = """
import os, warnings
import numpy as np
print('from the import')
os.chdir('/')
warnings.filterwarnings('error')
np.seterr(all='raise')
"""


def test_an_import_leaves_folder_warnings_numpy_and_stdout_alone(folder, capfd):
    code = observer("moves.calm").replace("    return", "    print('from the hook')\n    return")
    distribute(folder, "moves", "1", {"moves.calm": "moves"}, moves=MEDDLING + code)
    before = Path.cwd(), list(warnings.filters), np.geterr()
    assert found("moves").lookup("observer", "moves.calm").type == "moves.calm"
    assert (Path.cwd(), list(warnings.filters), np.geterr()) == before
    assert capfd.readouterr() == ("", "from the import\nfrom the hook\n")


@pytest.mark.parametrize("off", ["Five_Tribo", "*"])
def test_plugins_can_be_turned_off(folder, monkeypatch, off):
    distribute(folder, "five-tribo", "1.0", {"five.calm": "five_calm"}, five_calm="1/0")
    monkeypatch.setenv("TRIBO_DISABLE_PLUGINS", f" {off}, ")
    registry = found("five-tribo")
    assert [p.status for p in registry.plugins] == ["disabled"]
    with pytest.raises(CaseError, match=r"five-tribo 1\.0 is disabled: turned off"):
        registry.lookup("observer", "five.calm")
