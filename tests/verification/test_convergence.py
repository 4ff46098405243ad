"""Order, limit and uncertainty from three levels, against numbers made for it."""

import pytest

from tribo.verification.convergence import convergence


def made(order, sizes, limit=2.0, scale=0.3):
    return [limit + scale * h**order for h in sizes]


@pytest.mark.parametrize(("order", "safety"), [(1.1, 3.0), (1.75, 3.0), (1.9, 1.25), (2.0, 1.25)])
@pytest.mark.parametrize("sizes", [(4, 2, 1), (2.25, 1.5, 1), (9 / 4, 128 / 86, 1)])
def test_order_and_limit_of_a_power_are_found(order, safety, sizes):
    found = convergence(made(order, sizes), sizes, formal_order=2.0)
    assert found.behaviour == "converges"
    assert found.order == pytest.approx(order, rel=1e-8)
    assert found.limit == pytest.approx(2.0, rel=1e-8)
    assert found.uncertainty == pytest.approx(safety * 0.3, rel=1e-6)
    assert found.gci == pytest.approx(found.uncertainty / found.values[-1], rel=1e-8)


def test_an_example_that_can_be_worked_by_hand():
    # 1 + h²/10: the differences 0.175 and 0.125 stand in the ratio (4 - 9/4) : (9/4 - 1).
    found = convergence([1.4, 1.225, 1.1], [2.0, 1.5, 1.0], formal_order=2.0)
    assert found.order == pytest.approx(2.0)
    assert found.limit == pytest.approx(1.0)
    # 1.25 × 0.125/1.1 / (9/4 - 1)
    assert found.gci == pytest.approx(0.125 / 1.1)


@pytest.mark.parametrize("sizes", [(1 / 7, 1 / 8, 1 / 8), (1, 1, 1), (1 / 8, 1 / 7, 1 / 9)])
@pytest.mark.parametrize("values", [(1.0, 1.1, 1.12), (1.0, 1.1, 1.05), (1.0, 1.0, 1.0)])
def test_levels_that_are_no_refinement_show_no_order(values, sizes):
    found = convergence(values, sizes, formal_order=1.0)
    assert (found.behaviour, found.order, found.gci) == ("unrefined", None, None)
    assert found.uncertainty == pytest.approx(3 * (max(values) - min(values)), rel=1e-6, abs=0)


def test_the_uncertainty_of_a_coarser_level_is_its_own():
    sizes = (2.25, 1.5, 1)
    found = convergence(made(1.0, sizes), sizes, formal_order=1.0, own=0)
    assert found.uncertainty == pytest.approx(1.25 * 0.3 * 2.25, rel=1e-6)


def test_of_an_order_somewhat_beyond_the_formal_one_the_formal_is_used():
    sizes = (4, 2, 1)
    values = made(2.9, sizes)
    found = convergence(values, sizes, formal_order=2.0)
    assert (found.behaviour, found.order) == ("converges", pytest.approx(2.9))
    assert found.uncertainty == pytest.approx(3 * (values[1] - values[2]) / 3)


@pytest.mark.parametrize(("order", "formal"), [(3.1, 2.0), (8.3, 2.0), (0.9, 2.0), (0.4, 1.0)])
def test_nothing_is_extrapolated_with_an_order_far_from_the_formal_one(order, formal):
    sizes = (2.25, 1.5, 1)
    values = made(order, sizes)
    found = convergence(values, sizes, formal_order=formal)
    assert (found.behaviour, found.order) == ("not asymptotic", pytest.approx(order))
    assert (found.limit, found.gci) == (None, None)
    assert found.uncertainty == pytest.approx(3 * (values[0] - values[2]))


def test_equal_values_are_exact():
    found = convergence([3.0, 3.0 + 1e-12, 3.0], (4, 2, 1), formal_order=1.0)
    assert (found.behaviour, found.uncertainty) == ("exact", 0.0)
    assert convergence([0.0, 0.0, 0.0], (4, 2, 1), formal_order=1.0).behaviour == "exact"


@pytest.mark.parametrize("values", [(1.0, 1.2, 1.1), (1.0, 0.8, 0.9), (1.0, 1.2, 1.2)])
def test_oscillation_has_no_order_and_three_times_its_range_as_uncertainty(values):
    found = convergence(values, (4, 2, 1), formal_order=1.0)
    assert (found.behaviour, found.order, found.gci) == ("oscillates", None, None)
    assert found.uncertainty == pytest.approx(0.6)


@pytest.mark.parametrize("values", [(1.0, 1.1, 1.3), (1.0, 1.0, 1.1), (1.0, 1.1, 1.2), (0, 0, 1)])
def test_of_what_diverges_nothing_is_quoted(values):
    found = convergence(values, (4, 2, 1), formal_order=1.0)
    assert (found.behaviour, found.order, found.limit) == ("diverges", None, None)
    assert (found.gci, found.uncertainty) == (None, None)


def test_a_range_of_a_percent_or_of_what_is_counted_is_no_divergence():
    sizes = (4, 2, 1)
    small = convergence((1.0, 1.001, 1.01), sizes, formal_order=1.0)
    assert (small.behaviour, small.uncertainty) == ("scatters", pytest.approx(0.03))
    assert convergence((1.0, 1.0, 1.1), sizes, formal_order=1.0, scatter=0.05).uncertainty is None
    counted = convergence((1.0, 1.0, 1.1), sizes, formal_order=1.0, scatter=0.11)
    assert (counted.behaviour, counted.uncertainty) == ("scatters", pytest.approx(0.3))


def test_what_vanishes_at_the_finest_level_has_an_uncertainty():
    found = convergence((0.3, 0.1, 0.0), (4, 2, 1), formal_order=1.0)
    assert found.gci is None
    assert found.uncertainty > 0
