"""What counts as meeting the requirement of a case."""

import pytest

from tribo.config.requirements import check_requirements
from tribo.core.errors import CaseError
from tribo.registry.plugins import Plugin


def plugin(module, status, reason=""):
    return Plugin("pytest", "1", module, "installed", status, reason)


def test_a_distribution_counts_if_one_of_its_modules_is_usable():
    good, bad = plugin("a", "available"), plugin("b", "broken", "it raised")
    for plugins in ((), (good,), (good, bad), (bad, good)):
        check_requirements(["pytest"], plugins)
    with pytest.raises(CaseError, match="the plugin pytest 1 is broken: it raised"):
        check_requirements(["pytest"], [bad])
