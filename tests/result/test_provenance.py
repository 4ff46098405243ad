"""Where each model of a result came from, and when it counts as another."""

import pytest
from paper_models import archard

from tribo.result.provenance import changed_components, origin


def made(**changes):
    return {"components": {"contact": origin(archard()) | changes}}


def test_being_editable_is_no_change():
    assert changed_components(made(editable=False), made(editable=True)) == []


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"version": "9.9"}, "version 9.9"),
        ({"class": "other.Law", "distribution": "fork"}, "class other.Law, distribution fork"),
        ({"code": "abcdef0123456789"}, "code abcdef0123"),
        ({"facts": {"sha256": "beef"}}, "facts sha256 beef"),
    ],
)
def test_a_change_is_told_by_what_differs(changes, words):
    ((place, old, new),) = changed_components(made(), made(**changes))
    assert place == "contact"
    assert new == words
    assert old != new


def test_a_component_more_or_less_is_a_change():
    fewer = made()
    del fewer["components"]["contact"]
    ((_, old, _),) = changed_components(fewer, made())
    assert old == "not there"
