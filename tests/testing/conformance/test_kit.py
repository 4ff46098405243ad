"""What the kit says, and that it cannot be green without having looked."""

import subprocess
import sys
from typing import Annotated

import numpy as np
import pytest
from pydantic import ConfigDict
from testing.conformance.honest import Counts, Hill, Law
from testing.conformance.mutants_wear_law import SecantAsDerivative

from tribo.plugin import Grid, Quantity, Surface, WearRate
from tribo.testing import check, example_configs, parametrize_checks
from tribo.testing.kit import ENOUGH, SUITES, subjects
from tribo.testing.subject import CheckFailed
from tribo.wear.archard import Archard


def statuses(report):
    return {outcome.check: outcome.status for outcome in report.outcomes}


def test_a_report_counts_and_is_a_table():
    report = check(Hill, [{}, {"radius": "5 mm"}])
    assert report.ok
    assert (
        report.counts["passed"] == len(report.outcomes) == 2 * (len(SUITES["surface"].checks) + 1)
    )
    text = str(report)
    assert text.startswith("surface Hill (honest.hill): 42 passed")
    assert "  with radius=0.005\n" in text
    assert "    heights_are_finite_arrays " in text


def test_a_failure_says_what_was_found():
    report = check(SecantAsDerivative, [{}])
    assert not report.ok
    (failure,) = report.failures
    assert failure.fact.startswith("The derivative agrees with the differences")
    assert "the derivative is 1.8e-16 1/Pa, but the depth changes by" in str(report)


def test_an_expected_failure_is_reported_as_one():
    reason = {"derivative_is_that_of_the_depth": "the secant is steadier"}
    report = check(SecantAsDerivative, [{}], expected_failures=reason)
    assert report.ok
    assert statuses(report)["derivative_is_that_of_the_depth"] == "expected failure"
    assert "the secant is steadier" in str(report)


def test_an_unexpected_pass_fails():
    report = check(Hill, [{}], expected_failures={"name_has_a_prefix": "no time"})
    assert [failure.check for failure in report.failures] == ["name_has_a_prefix"]
    assert "although a failure is expected (no time)" in report.failures[0].message


class Unknown(Hill):
    @property
    def curvature(self):
        return None


def test_what_is_not_declared_does_not_apply():
    report = check(Unknown, [{}])
    assert statuses(report)["curvature_is_that_of_the_heights"] == "not applicable"
    assert report.ok


def test_too_few_checks_fail():
    names = [one.name for one in SUITES["surface"].checks][:6]
    report = check(Hill, [{}], expected_failures=dict.fromkeys(names, "all too hard"))
    assert statuses(report)[ENOUGH] == "failed"
    assert "only 14 of 20 checks apply; at least 17 must" in str(report)


def test_no_configuration_is_no_success():
    assert not check(Hill, []).ok
    with pytest.raises(ValueError, match="nothing would be checked of Hill"):
        parametrize_checks(Hill, [])


def test_the_minimum_can_be_met_by_the_plainest_implementation():
    for suite in SUITES.values():
        assert suite.minimum < len(suite.checks)


@pytest.mark.parametrize(
    ("cls", "message"),
    [
        (Grid, "exactly one of ContactSolver, WearLaw"),
        (3, "3 is not a class"),
        (type("Empty", (Surface,), {}), "Empty does not define height"),
    ],
)
def test_what_is_no_component_is_refused(cls, message):
    with pytest.raises(TypeError, match=message):
        check(cls, [{}])


def test_what_the_author_got_wrong_is_named():
    with pytest.raises(ValueError, match=r"configs\[1\] is not valid for Hill: .*\n.*radius"):
        check(Hill, [{}, {"radius": "5 s"}])
    with pytest.raises(ValueError, match="no check of a surface is called 'heigths'"):
        check(Hill, [{}], expected_failures={"heigths": "because"})
    with pytest.raises(ValueError, match="say why 'name_has_a_prefix'"):
        check(Hill, [{}], expected_failures={"name_has_a_prefix": " "})


class Shown(Law):
    model_config = ConfigDict(json_schema_extra={"examples": [{"q": 1}, {"q": 2}]})
    type = "shown.law"
    q: Annotated[float, Quantity("1")]
    """Something."""


class Hidden(Shown):
    model_config = ConfigDict(json_schema_extra=None)


def test_examples_come_from_the_schema():
    assert example_configs(Shown) == [{"q": 1}, {"q": 2}]
    assert example_configs(Hidden) == []
    assert example_configs(Counts) == [{}]


def test_defaults_that_are_not_valid_are_no_example():
    class OneOfTwo(Archard):
        model_config = ConfigDict(json_schema_extra=None)

    assert example_configs(OneOfTwo) == []


def test_fields_take_the_values_given():
    seen = []

    class Sees(Law):
        def rate(self, local):
            seen.append(local.fields["friction_coefficient"].max())
            return super().rate(local)

    check(Sees, [{}], fields={"friction_coefficient": 7.0})
    assert 6 < max(seen) < 8


class Heated(Law):
    """Its derivative follows a field that follows the pressure."""

    requires = ("heat",)

    def rate(self, local):
        heat = local.fields["heat"]
        touching = np.where(local.pressure > 0, heat, 0.0)
        return WearRate(1e-16 * touching, np.full_like(heat, 2e-16), {"rubbed": 0 * heat})


def test_a_field_may_follow_the_pressure():
    checks = {one.name: one for one in SUITES["wear_law"].checks}
    agrees = checks["derivative_is_that_of_the_depth"]
    (held,) = subjects(Heated, [{}], {"heat": 1e9})
    (followed,) = subjects(Heated, [{}], {"heat": lambda pressure: 2 * pressure})
    with pytest.raises(CheckFailed, match="Fields that follow the pressure"):
        agrees.run(held)
    agrees.run(followed)


class Sloped(Law):
    """Its derivative is by a slope that it is told."""

    requires = ("heat", "heat_slope")

    def rate(self, local):
        touching = local.pressure > 0
        return WearRate(
            np.where(touching, 1e-16 * local.fields["heat"], 0.0),
            1e-16 * local.fields["heat_slope"],
            {"rubbed": 1.0 * touching},
        )


@pytest.mark.parametrize("fields", [{}, {"heat_slope": 2.0}, {"heat": lambda pressure: pressure}])
def test_a_field_whose_slope_is_required_follows_the_pressure(fields):
    report = check(Sloped, [{}], fields=fields)
    assert report.ok, str(report)


PYTEST = """
from testing.conformance.honest import Hill
from testing.conformance.mutants_surface import InwardHeight
from tribo.testing import parametrize_checks

WRONG = {"curvature_is_that_of_the_heights": "made so"}

class Unknown(Hill):
    @property
    def curvature(self):
        return None

test_honest = parametrize_checks(Hill, configs=[{}])
test_known = parametrize_checks(InwardHeight, configs=[{}], expected_failures=WRONG)
test_wrong = parametrize_checks(InwardHeight, configs=[{}])
test_mended = parametrize_checks(Hill, configs=[{}], expected_failures=WRONG)
test_unknown = parametrize_checks(Unknown, configs=[{}])
"""


def test_pytest_runs_each_check(tmp_path):
    (tmp_path / "test_them.py").write_text(PYTEST)
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-rA", "-p", "no:cacheprovider", "test_them.py"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        env={"PYTHONPATH": ":".join(sys.path)},
    )
    assert "2 failed, 101 passed, 1 skipped, 1 xfailed" in done.stdout
    assert "The curvature is that at the highest point" in done.stdout
    assert "FAILED test_them.py::test_wrong[curvature_is_that_of_the_heights-0]" in done.stdout
    assert "FAILED test_them.py::test_mended[curvature_is_that_of_the_heights-0]" in done.stdout
    assert "kit.py" not in done.stdout


def test_the_kit_works_without_pytest():
    code = (
        "import sys; sys.modules['pytest'] = None\n"
        "from tribo.testing import check; from tribo.surfaces.flat import Flat\n"
        "assert check(Flat, [{}]).ok"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
