"""One rule for the names of third parties, which the loader and the scaffolder share."""

from __future__ import annotations

import pytest

from tribo.core.errors import CaseError
from tribo.registry.names import name_fault
from tribo.scaffold import PluginName


@pytest.mark.parametrize("name", ["acme.fretting", "a.b", "lab2.wear_3", "acme.dry.Archard"])
def test_a_prefix_and_a_name_will_do(name: str) -> None:
    assert name_fault(name) == ""


@pytest.mark.parametrize(
    ("name", "fault"),
    [
        ("fretting", "needs a prefix"),
        ("", "needs a prefix"),
        (".x", "not made of a prefix"),
        ("x.", "not made of a prefix"),
        ("a..b", "not made of a prefix"),
        ("2d.x", "not made of a prefix"),
        ("Acme.x", "not made of a prefix"),
        ("acme.fret-ting", "not made of a prefix"),
        ("acme.fret ting", "not made of a prefix"),
        ("acme.maß", "not made of a prefix"),
        ("acme.x\n", "not made of a prefix"),
        ("tribo.x", "prefix 'tribo', which is tribo's own"),
    ],
)
def test_any_other_is_refused_with_the_reason(name: str, fault: str) -> None:
    assert fault in name_fault(name)


@pytest.mark.parametrize("distribution", ["acme-fretting", "lab2-wear-3", "acme-twin-disk"])
def test_what_the_scaffolder_accepts_the_loader_does_too(distribution: str) -> None:
    assert name_fault(PluginName(distribution).component) == ""


def test_the_scaffolder_refuses_the_prefix_that_the_loader_does() -> None:
    with pytest.raises(CaseError, match=r"'tribo\.fretting' has the prefix 'tribo'"):
        PluginName("tribo-fretting")
