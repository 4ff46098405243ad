"""Every check of `tribo verify` holds, says what its error is, and can fail."""

from dataclasses import replace

import pytest

from tribo.core.errors import NumericalError
from tribo.verification.check import Check, Quantity, observed_order, run_check
from tribo.verification.suite import CHECKS


@pytest.mark.parametrize("check", CHECKS, ids=lambda check: check.case)
def test_check_holds(check):
    rows = run_check(check)
    assert [row.quantity for row in rows] == [quantity.name for quantity in check.quantities]
    for row in rows:
        if row.verdict == "not installed":
            pytest.skip(f"{' or '.join(check.needs)} is not installed")
        assert row.verdict == "holds", row


def test_every_quantity_has_an_order_or_says_what_its_error_is():
    for check in CHECKS:
        for quantity in check.quantities:
            assert quantity.order is not None or quantity.note, (check.case, quantity.name)
            assert quantity.order is None or len(check.levels) == 3, check.case


def test_names_of_cases_are_unique():
    assert len({check.case for check in CHECKS}) == len(CHECKS)


def made(error, **changes):
    quantity = Quantity("x", "m", **{"tolerance": 0.02, "order": 2.0, **changes})
    return Check(
        "c", "s", lambda n, _: {"x": (5.0, 5.0 * (1 + error(n)))}, (quantity,), (10, 20, 40)
    )


def verdict(check):
    return run_check(check)[0].verdict


def test_a_check_holds_with_the_order_and_within_the_tolerance_only():
    assert verdict(made(lambda n: 1 / n**2)) == "holds"
    assert verdict(made(lambda n: 1 / n**1.7)) == "fails"
    assert verdict(made(lambda n: 1 / n**2.3)) == "fails"
    assert verdict(made(lambda n: 40 / n**2)) == "fails"
    assert verdict(made(lambda n: -1 / n**2)) == "holds"
    assert verdict(made(lambda n: float("nan"))) == "fails"
    # Without an error there is no order to be seen.
    assert verdict(made(lambda n: 0.0)) == "fails"
    assert verdict(made(lambda n: 0.0, order=None)) == "holds"


def test_errors_are_relative_and_the_root_mean_square_over_placements():
    check = replace(made(lambda n: 0.0, order=None), placements=2)
    check = replace(check, measure=lambda n, placed: {"x": (2.0, 2.0 + 0.02 * (placed > 0))})
    row = run_check(check)[0]
    assert row.error == pytest.approx(0.01 / 2**0.5)
    assert (row.expected, row.got) == (2.0, 2.0)


def test_where_nothing_is_expected_the_error_is_what_was_got():
    check = replace(made(lambda n: 0.0, order=None), measure=lambda n, _: {"x": (0.0, 0.01)})
    assert run_check(check)[0].error == 0.01


def test_another_code_that_is_missing_or_breaks_is_told_from_one_that_disagrees():
    def broken(n, _):
        raise AttributeError("no such function")

    missing = replace(made(lambda n: 0.0), needs=("no_such_module",))
    assert verdict(missing) == "not installed"
    row = run_check(replace(missing, needs=("json",), measure=broken))[0]
    assert (row.verdict, row.note) == ("fails", "no such function")
    with pytest.raises(AttributeError):
        run_check(replace(missing, needs=(), measure=broken))


def test_a_solve_that_fails_fails_its_check_and_says_why():
    def unsolved(n, _):
        raise NumericalError("did not converge")

    row = run_check(replace(made(lambda n: 0.0), measure=unsolved))[0]
    assert (row.verdict, row.note, row.got) == ("fails", "did not converge", None)


def test_order_needs_three_levels_and_errors():
    assert observed_order((10, 20, 40), [4.0, 2.0, 1.0]) == pytest.approx(1.0)
    assert observed_order((10, 20), [4.0, 2.0]) is None
    assert observed_order((10, 20, 40), [4.0, 2.0, 0.0]) is None
