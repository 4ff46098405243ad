"""Order, limit and uncertainty from three levels, against numbers made for it."""

import pytest

from tribo.verification.convergence import convergence

HALVES = (4, 2, 1)


def made(order, sizes, limit=2.0, scale=0.3):
    return [limit + scale * h**order for h in sizes]


@pytest.mark.parametrize(("order", "safety"), [(1.1, 3.0), (1.75, 3.0), (1.9, 1.25), (2.0, 1.25)])
@pytest.mark.parametrize("sizes", [HALVES, (2.25, 1.5, 1), (9 / 4, 128 / 86, 1)])
def test_order_and_limit_of_a_power_are_found(order, safety, sizes):
    found = convergence(made(order, sizes), sizes, formal_order=2.0)
    assert found.order == pytest.approx(order, rel=1e-8)
    assert found.limit == pytest.approx(2.0, rel=1e-8)
    assert found.uncertainty == pytest.approx(safety * 0.3, rel=1e-6)
    assert found.gci == pytest.approx(found.uncertainty / found.values[-1], rel=1e-8)


def test_the_uncertainty_of_a_coarser_level_is_its_own():
    sizes = (2.25, 1.5, 1)
    found = convergence(made(1.0, sizes), sizes, formal_order=1.0, own=0)
    assert found.uncertainty == pytest.approx(1.25 * 0.3 * 2.25, rel=1e-6)


def test_of_an_order_somewhat_beyond_the_formal_one_the_formal_is_used():
    values = made(2.9, HALVES)
    found = convergence(values, HALVES, formal_order=2.0)
    assert found.order == pytest.approx(2.9)
    assert found.uncertainty == pytest.approx(3 * (values[1] - values[2]) / 3)


@pytest.mark.parametrize(
    "values",
    [
        *(made(order, HALVES) for order in (3.1, 8.3, 0.9)),
        *((1.0, 1.2, 1.1), (1.0, 0.8, 0.9), (1.0, 1.2, 1.2), (1.0, 1.1, 1.3), (1.0, 1.0, 1.1)),
        *((0.0, 0.0, 1.0), (3.0, 3.0, 3.0)),
    ],
)
def test_without_an_order_near_the_formal_one_three_times_the_range_is_quoted(values):
    found = convergence(values, HALVES, formal_order=2.0)
    assert (found.order, found.limit, found.gci) == (None, None, None)
    assert found.uncertainty == pytest.approx(3 * (max(values) - min(values)), rel=1e-6, abs=0)


@pytest.mark.parametrize("sizes", [(1 / 7, 1 / 8, 1 / 8), (1, 1, 1), (1 / 8, 1 / 7, 1 / 9)])
def test_levels_that_are_no_refinement_show_no_order(sizes):
    found = convergence((1.0, 1.1, 1.12), sizes, formal_order=1.0)
    assert (found.order, found.uncertainty) == (None, pytest.approx(0.36, rel=1e-6))


def test_what_vanishes_at_the_finest_level_has_an_uncertainty():
    found = convergence((0.3, 0.1, 0.0), HALVES, formal_order=1.0)
    assert found.gci is None
    assert found.uncertainty > 0
