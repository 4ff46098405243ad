"""A public name goes only after a minor version in which it warns."""

from importlib import metadata
from pathlib import Path
from types import SimpleNamespace

import pytest
from packaging.version import Version

import tribo

NAMES = Path(__file__).with_name("public_names.txt").read_text().split("\n", 1)[1].split()


def test_a_name_of_the_last_version_is_public_or_deprecated():
    assert set(NAMES) <= {*tribo.__all__, *tribo.DEPRECATED}


def test_a_deprecated_name_has_gone_in_its_version_and_warned_for_a_minor_one_before():
    present = Version(metadata.version("tribo"))
    for new, version in tribo.DEPRECATED.values():
        assert new in tribo.__all__
        assert Version(version).release[:2] > present.release[:2]


def test_a_deprecated_name_is_the_new_one_with_a_warning_at_its_use(monkeypatch):
    monkeypatch.setitem(tribo.DEPRECATED, "LinearLaw", ("Archard", "7.3"))
    with pytest.warns(DeprecationWarning, match=r"LinearLaw.* tribo\.Archard.* 7\.3") as caught:
        assert tribo.LinearLaw is tribo.Archard
    with pytest.warns(DeprecationWarning, match="LinearLaw"):
        from tribo import LinearLaw
    assert LinearLaw is tribo.Archard
    assert caught[0].filename == __file__


def test_the_notices_of_a_result_are_its_warnings():
    with pytest.warns(DeprecationWarning, match="Result.warnings"):
        assert tribo.Result.notices.fget(SimpleNamespace(warnings=("one",))) == ("one",)
