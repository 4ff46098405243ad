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
    assert found.behaviour == "converges"
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


@pytest.mark.parametrize(
    ("behaviour", "values"),
    [
        ("oscillates", (1.0, 1.2, 1.1)),
        ("oscillates", (1.0, 0.8, 0.9)),
        ("oscillates", (1.0, 1.2, 1.2)),
        ("diverges", (1.0, 1.1, 1.3)),
        ("diverges", (1.0, 1.0, 1.1)),
        ("diverges", (1.0, 1.1, 1.2)),
        ("diverges", (0.0, 0.0, 1.0)),
        # A range of a percent is no divergence.
        ("scatters", (1.0, 1.001, 1.01)),
        ("exact", (3.0, 3.0 + 1e-12, 3.0)),
        ("exact", (0.0, 0.0, 0.0)),
    ],
)
def test_without_an_order_three_times_the_range_is_quoted_or_nothing(behaviour, values):
    found = convergence(values, HALVES, formal_order=1.0)
    assert (found.behaviour, found.order, found.limit) == (behaviour, None, None)
    if behaviour == "diverges":
        assert (found.gci, found.uncertainty) == (None, None)
    else:
        spread = 0.0 if behaviour == "exact" else max(values) - min(values)
        assert found.uncertainty == pytest.approx(3 * spread, abs=0)


@pytest.mark.parametrize("sizes", [(1 / 7, 1 / 8, 1 / 8), (1, 1, 1), (1 / 8, 1 / 7, 1 / 9)])
@pytest.mark.parametrize("values", [(1.0, 1.1, 1.12), (1.0, 1.1, 1.05), (1.0, 1.0, 1.0)])
def test_levels_that_are_no_refinement_show_no_order(values, sizes):
    found = convergence(values, sizes, formal_order=1.0)
    assert (found.behaviour, found.order, found.gci) == ("unrefined", None, None)
    assert found.uncertainty == pytest.approx(3 * (max(values) - min(values)), rel=1e-6, abs=0)


@pytest.mark.parametrize(("scatter", "uncertainty"), [(0.05, None), (0.11, pytest.approx(0.3))])
def test_the_cells_in_which_a_width_is_counted_are_no_divergence(scatter, uncertainty):
    found = convergence((1.0, 1.0, 1.1), HALVES, formal_order=1.0, scatter=scatter)
    assert found.uncertainty == uncertainty


def test_what_vanishes_at_the_finest_level_has_an_uncertainty():
    found = convergence((0.3, 0.1, 0.0), HALVES, formal_order=1.0)
    assert found.gci is None
    assert found.uncertainty > 0
