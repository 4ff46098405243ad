"""What a case requires is installed, in that version and usable, or reading it is refused."""

import tomllib

import pytest

from tribo import CaseError
from tribo.config.load import validate_case
from tribo.registry.plugins import Plugin, check_requirements
from tribo.templates import template


def case_that_requires(text):
    validate_case({"requires": [text], **tomllib.loads(template("ball_on_disk"))})


@pytest.mark.parametrize(
    ("required", "told"),
    [
        ("pytest>=1", ""),
        ("no-such-thing; python_version < '3'", ""),
        ("no-such-thing; python_version >= '3'", "no-such-thing is not installed"),
        ("pytest<1", "pytest is installed in version"),
        ("pytest?", "is not a requirement"),
    ],
)
def test_a_distribution_is_needed_in_its_version_where_its_marker_holds(required, told):
    if not told:
        case_that_requires(required)
        return
    with pytest.raises(CaseError, match=told) as caught:
        case_that_requires(required)
    assert caught.value.path == "requires"


def plugin(module, status, reason=""):
    return Plugin("pytest", "1", module, "installed", status, reason, load=object)


def test_a_distribution_counts_if_one_of_its_modules_is_usable():
    good, bad = plugin("a", "available"), plugin("b", "broken", "it raised")
    for plugins in ((), (good,), (good, bad), (bad, good)):
        check_requirements(["pytest"], plugins)
    with pytest.raises(ValueError, match="the plugin pytest 1 is broken: it raised"):
        check_requirements(["pytest"], [bad])
