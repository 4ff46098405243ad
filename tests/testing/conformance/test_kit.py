"""What the kit reports, and that it cannot be green without having looked."""

import inspect
import subprocess
import sys
from contextlib import nullcontext
from dataclasses import replace
from typing import Annotated

import numpy as np
import pytest
from testing.conformance.honest_laws import Law
from testing.conformance.honest_others import Counts, Hill
from testing.conformance.mistakes import MISTAKES

from tribo import Field, Grid, Quantity, Sphere, Surface, WearRate
from tribo.testing import check, parametrize_checks
from tribo.testing.compare import CheckFailed
from tribo.testing.kit import suites
from tribo.wear.archard import Archard

InwardHeight = MISTAKES["Its height is that of the gap"]
CURVATURE = "curvature_is_that_of_the_heights"


def statuses(report):
    return {outcome.check: outcome.status for outcome in report.outcomes}


def test_a_report_is_a_table_of_every_check_with_every_configuration():
    report = check(Hill, [{}, {"radius": "5 mm"}])
    assert report.ok
    text = str(report).splitlines()
    assert text[0] == f"surface Hill (honest.hill): {len(report.outcomes)} passed"
    assert "  with Hill(radius=0.005)" in text
    assert len(text) == 3 + len(report.outcomes)


def look_up(local):
    return {}["wear"]


class Raises(Law):
    def rate(self, local):
        return look_up(local)


def test_an_exception_is_told_once_with_the_line_it_arose_in():
    report = check(Raises, [{}])
    line = inspect.getsourcelines(look_up)[1] + 1
    assert str(report).count("it raised KeyError: 'wear'") == 1
    assert f"({__file__}, line {line}) (this spoils " in str(report)
    assert f"{len(report.failures)} failed" in str(report).splitlines()[0]


class Elsewhere(Hill):
    type = "test.elsewhere"


def test_a_class_that_only_this_process_has_is_checked_in_it(monkeypatch):
    # As one of a script: another process has a __main__ of its own.
    monkeypatch.setattr(Elsewhere, "__module__", "__main__")
    monkeypatch.setattr(sys.modules["__main__"], "Elsewhere", Elsewhere, raising=False)
    report = check(Elsewhere, [{}])
    assert report.ok


class Unknown(Hill):
    @property
    def curvature(self):
        return None


@pytest.mark.parametrize("run", [check, parametrize_checks])
@pytest.mark.parametrize(
    ("cls", "configs", "error", "message"),
    [
        (Grid, [{}], TypeError, "exactly one of ContactSolver, WearLaw"),
        (3, [{}], TypeError, "3 is not a class"),
        (
            type("Empty", (Surface,), {}),
            [{}],
            TypeError,
            r"no method height; help\(tribo.Surface\)",
        ),
        (Hill, [], ValueError, "nothing would be checked of Hill"),
        (
            Hill,
            [{}, {"radius": "5 s"}],
            ValueError,
            "Hill has no valid configuration at 1: radius: ",
        ),
    ],
)
def test_what_the_author_got_wrong_is_named(run, cls, configs, error, message):
    with pytest.raises(error, match=message):
        run(cls, configs)


class OneOfTwo(Archard):
    examples = ()


def test_examples_are_those_of_the_class_or_its_defaults():
    for cls, config in ((Sphere, "Sphere(radius=0.005)"), (Counts, "Counts()")):
        assert {outcome.config for outcome in check(cls).outcomes} == {config}
    with pytest.raises(ValueError, match="valid ones as examples"):
        check(OneOfTwo)


class Heated(Law):
    """Its derivative follows a field that follows the pressure."""

    requires = (Field("heat", "Pa", "Power of friction."),)
    state_fields = ()

    def rate(self, local):
        heat = np.where(local.pressure > 0, 1e-16 * local.fields["heat"], 0.0)
        return WearRate(heat, np.full_like(heat, 2e-16))


class Sloped(Heated):
    """Its derivative is by a slope that it is told."""

    requires = (*Heated.requires, Field("heat_slope", "1", "Its derivative in pressure."))

    def rate(self, local):
        return replace(super().rate(local), depth_slope=1e-16 * local.fields["heat_slope"])


def test_a_field_follows_the_pressure_by_its_slope_alone():
    (sound,), (wrong,) = (suites(cls, [{}]) for cls in (Sloped, Heated))
    sound.slopes_are_derivatives()
    with pytest.raises(CheckFailed, match="by its slope"):
        wrong.slopes_are_derivatives()


class Protected(Law):
    """A law of a film some 50 nm thick, which nothing here provides."""

    requires = (Field("zddp_film", "m", "Thickness of ZDDP.", at_least=0, typical=5e-8),)
    state_fields = ()
    thickness: Annotated[float, Quantity("m", above=0)] = 5e-8
    """Film that takes the wear to 1/e."""

    def rate(self, local):
        k = self.k * np.exp(-local.fields["zddp_film"] / self.thickness)
        return WearRate(k * local.pressure, k)


class Bare(Heated):
    requires = ("heat",)


def test_a_field_that_is_required_must_say_its_values():
    assert "heat: a name tells no values" in str(check(Bare, [{}]))


def test_a_law_is_tried_at_the_scale_of_the_field_that_it_requires():
    report = check(Protected, [{}])
    assert report.ok, str(report)
    assert statuses(report)["what_is_declared_matters"] == "passed"


@pytest.mark.parametrize(
    ("cls", "raised"),
    [
        (Hill, nullcontext()),
        (InwardHeight, pytest.raises(pytest.fail.Exception, match="The curvature is that at the")),
        (Unknown, pytest.raises(pytest.skip.Exception)),
    ],
)
def test_pytest_reports_each_check(cls, raised):
    test = parametrize_checks(cls, [{}])
    (cases,) = (mark.args[1] for mark in test.pytestmark)
    (case,) = (each for each in cases if each.id == f"{CURVATURE}-0")
    with raised:
        test(*case.values)


@pytest.mark.slow
def test_the_kit_works_without_pytest():
    code = "import sys; sys.modules['pytest'] = None; import tribo.testing"
    subprocess.run([sys.executable, "-c", code], check=True)
