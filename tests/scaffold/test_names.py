"""All names of a plugin follow from that of its distribution."""

import pytest

from tribo.core.errors import CaseError
from tribo.scaffold import plugin_names


@pytest.mark.parametrize(
    ("distribution", "package", "component", "title"),
    [
        ("acme-fretting", "acme_fretting", "acme.fretting", "Fretting"),
        ("acme-twin-disk", "acme_twin_disk", "acme.twin_disk", "TwinDisk"),
        ("lab2-wear-3", "lab2_wear_3", "lab2.wear_3", "Wear3"),
    ],
)
def test_the_names_follow_from_the_distribution(distribution, package, component, title):
    names = plugin_names(distribution)
    assert (names["package"], names["component"], names["title"]) == (package, component, title)


@pytest.mark.parametrize(
    ("given", "remedy"),
    [
        ("fretting", "as 'acme-fretting'"),
        ("Acme_Fretting", "as 'acme-fretting'"),
        ("../up", "as 'acme-fretting'"),
        ("", "as 'acme-fretting'"),
        ("acme-3d", "as 'acme-fretting'"),
        ("acme-lambda", "'lambda', which is a keyword"),
        ("acme-wear-law", "'WearLaw', which is tri"),
    ],
)
def test_a_name_that_cannot_be_used_is_refused_with_a_remedy(given, remedy):
    with pytest.raises(CaseError, match=remedy):
        plugin_names(given)
