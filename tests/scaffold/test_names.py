"""All names of a plugin follow from that of its distribution."""

from __future__ import annotations

import pytest

from tribo.core.errors import CaseError
from tribo.scaffold import PluginName


@pytest.mark.parametrize(
    ("distribution", "package", "component", "title"),
    [
        ("acme-fretting", "acme_fretting", "acme.fretting", "Fretting"),
        ("acme-twin-disk", "acme_twin_disk", "acme.twin_disk", "TwinDisk"),
        ("lab2-wear-3", "lab2_wear_3", "lab2.wear_3", "Wear3"),
    ],
)
def test_the_names_follow_from_the_distribution(
    distribution: str, package: str, component: str, title: str
) -> None:
    name = PluginName(distribution)
    assert (name.package, name.component, name.title) == (package, component, title)


@pytest.mark.parametrize(
    ("given", "remedy"),
    [
        ("fretting", "try 'acme-fretting'"),
        ("Acme_Fretting", "try 'acme-fretting'"),
        ("acme.fretting", "try 'acme-fretting'"),
        ("acme-", "one is needed as 'acme-fretting'"),
        ("../up", "try 'acme-up'"),
        ("", "one is needed as 'acme-fretting'"),
        ("acme-3d", "one is needed as 'acme-fretting'"),
        ("ärger-maß", "in lower-case words joined by hyphens"),
    ],
)
def test_a_name_of_another_form_is_refused_with_a_remedy(given: str, remedy: str) -> None:
    with pytest.raises(CaseError, match="is no good as a plugin's name") as caught:
        PluginName(given)
    assert remedy in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("given", "why"),
    [
        ("acme-lambda", "'lambda', which is a keyword"),
        ("acme-wear-law", "'WearLaw', which is tri"),
        ("acme-" + 26 * "x", "too long for a plugin's name; 30 characters are allowed"),
    ],
)
def test_a_name_that_would_spoil_the_code_is_refused(given: str, why: str) -> None:
    with pytest.raises(CaseError, match=why):
        PluginName(given)
