"""Every row of `tribo verify` holds, says what its error is, and can fail."""

from dataclasses import replace

import pytest

from tribo.core.errors import NumericalError
from tribo.verification.reference import Reference, Row
from tribo.verification.suite import REFERENCES


@pytest.mark.slow
@pytest.mark.parametrize("known", REFERENCES, ids=lambda known: known.case)
def test_rows_hold_and_say_what_their_error_is(known):
    for row in known.run():
        if row.verdict == "not installed":
            pytest.skip(f"{' or '.join(known.needs)} is not installed")
        assert row.verdict == "holds", row
        assert row.note or (row.theory is not None and len(known.levels) == 3)


def test_a_problem_that_raises_is_a_row_that_fails():
    (row,) = Reference("broken", "nobody", lambda level, placement: 1 / 0, (8,)).run()
    assert (row.case, row.verdict) == ("broken", "fails")
    assert "ZeroDivisionError" in row.note


def test_names_of_cases_are_unique():
    assert len({known.case for known in REFERENCES}) == len(REFERENCES)


def made(error, order=2.0, **changes):
    def rows(n, placement):
        return [Row("x", "m", 5.0, 5.0 * (1 + error(n)), 0.02, order)]

    return replace(Reference("c", "s", rows, (10, 20, 40)), **changes)


@pytest.mark.parametrize(
    ("error", "order", "verdict"),
    [
        (lambda n: 1 / n**2, 2.0, "holds"),
        (lambda n: -1 / n**2, 2.0, "holds"),
        (lambda n: 1 / n**1.7, 2.0, "fails"),
        (lambda n: 1 / n**2.3, 2.0, "fails"),
        (lambda n: 40 / n**2, 2.0, "fails"),
        (lambda n: float("nan"), 2.0, "fails"),
        # Without an error there is no order to be seen.
        (lambda n: 0.0, 2.0, "fails"),
        (lambda n: 0.0, None, "holds"),
    ],
)
def test_a_row_holds_with_its_order_and_within_its_tolerance_only(error, order, verdict):
    assert made(error, order).run()[0].verdict == verdict


def test_errors_are_relative_and_the_root_mean_square_over_placements():
    def rows(n, placed):
        return [Row("x", "m", 2.0, 2.0 + 0.02 * (placed > 0), 0.1), Row("y", "1", 0.0, 0.01, 0.1)]

    x, y = made(None, rows=rows, placements=2).run()
    assert (x.expected, x.got, x.error) == (2.0, 2.0, pytest.approx(0.01 / 2**0.5))
    # Where nothing is expected the error is what was got.
    assert (y.case, y.source, y.error) == ("c", "s", 0.01)


def test_another_code_that_is_missing_or_breaks_is_told_from_one_that_disagrees():
    other = made(None, needs=("no_such_module",))
    assert [row.verdict for row in other.run()] == ["not installed"]
    (row,) = replace(other, needs=("json",)).run()
    assert (row.verdict, row.note) == ("fails", "TypeError: 'NoneType' object is not callable")


def test_a_solve_that_fails_fails_its_reference_and_says_why():
    def unsolved(n, _):
        raise NumericalError("did not converge")

    row = made(None, rows=unsolved).run()[0]
    assert (row.verdict, row.note, row.got) == ("fails", "did not converge", None)
