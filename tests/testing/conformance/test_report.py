"""What one fault does to many checks is told once, with its place."""

import inspect

import testing.conformance.test_report as here
from testing.conformance.honest import Law

from tribo.testing import check


class Raises(Law):
    def rate(self, local):
        return _look_up(local)


def _look_up(local):
    return {}["wear"]


def test_an_exception_is_told_once_with_the_line_it_arose_in():
    report = check(Raises, [{}, {"k": 2e-16}])
    spoiled = [f for f in report.failures if "KeyError" in f.message]
    assert len(spoiled) > 10
    line = inspect.getsourcelines(_look_up)[1] + 1
    place = (
        f"it raised KeyError in {here.__file__}:{line}: 'wear' (this spoils {len(spoiled)} checks)"
    )
    assert str(report).count("KeyError") == 1
    assert place in str(report)
    assert f"{len(report.failures)} failed" in str(report).splitlines()[0]
