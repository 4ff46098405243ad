"""Rates integrated over an increment, against closed forms."""

import numpy as np
import pytest
from scipy.special import lambertw

from tribo.core.errors import BadValues
from tribo.stepping.division import integrated
from tribo.stepping.integrator import Kept, Sum, retraced, transposed

ANY = Kept("a", "a test")
ONE = np.ones((1, 1))
ONE_SUM = [Sum()]


def turning(period):
    """A state that oscillates undamped, a' = 2π b / λ and b' = −2π a / λ, from 1 and 0."""
    turns = 2 * np.pi / period

    def rates(values, passed):
        return [turns * values[1], -turns * values[0]]

    return rates


def test_an_oscillation_over_many_periods_is_refused_and_never_unstable():
    with pytest.raises(BadValues, match=r"\('a' of a test, 'a' of a test\) changes too often"):
        integrated(turning(0.05), [ONE, 0 * ONE], 3.0, [ANY, ANY])


def test_an_oscillation_over_some_periods_is_followed():
    a, b = integrated(turning(1.0), [ONE, 0 * ONE], 1.25, [ANY, ANY]).values
    assert a[0, 0] == pytest.approx(0, abs=1e-3)
    assert b[0, 0] == pytest.approx(-1, abs=1e-3)


def test_a_rate_that_is_zero_at_both_ends_is_integrated():
    def rates(values, passed):
        return [ONE, passed * (1 - passed) * (1 + 1e-4 * passed**2) * ONE]

    (total,) = integrated(rates, [0 * ONE], 1.0, [ANY], ONE_SUM).sums
    assert total[0, 0] == pytest.approx(1 / 6 + 1e-4 / 20, rel=3e-5)


@pytest.mark.parametrize("at", [1e-7, 1e-4, 0.3])
def test_a_rate_that_jumps_is_followed_wherever_it_does(at):
    def rates(values, passed):
        return [ONE, ONE if passed < at else 3 * ONE]

    (total,) = integrated(rates, [0 * ONE], 1.0, [ANY], ONE_SUM).sums
    assert total[0, 0] == pytest.approx(3 - 2 * at, abs=3e-4)


@pytest.mark.parametrize("length", [0.5, 3.5, 10.0, 1000.0])
def test_a_state_relaxes_alike_with_limits_and_without_however_long_the_increment(length):
    def decay(values, passed):
        return [-values[0]]

    def slower(values, passed):
        return [-(values[0] ** 2)]

    between = Kept("a", "a test", 0.0)
    (decayed,) = integrated(decay, [ONE], length, [between]).values
    (slowed,) = integrated(slower, [ONE], length, [between]).values
    assert decayed[0, 0] == pytest.approx(np.exp(-length), rel=1e-9, abs=1e-300)
    assert slowed[0, 0] == pytest.approx(1 / (1 + length), rel=1e-3)


BETWEEN = Kept("a", "a test", 0.0, 1.0)


@pytest.mark.parametrize("length", [2.0, 3.5, 7.1, 70.0, 3e5])
def test_a_state_that_begins_at_a_limit_leaves_it_however_long_the_increment(length):
    (grown,) = integrated(lambda values, _: [1 - values[0]], [0 * ONE], length, [BETWEEN]).values
    assert grown[0, 0] == pytest.approx(-np.expm1(-length), rel=1e-6)


@pytest.mark.parametrize("length", [0.7, 1.5, 12.0, 1000.0])
def test_a_state_may_come_to_its_limit_within_the_increment(length):
    (left,) = integrated(
        lambda values, _: [-2 * np.sqrt(np.maximum(values[0], 0))], [ONE], length, [BETWEEN]
    ).values
    assert left[0, 0] == pytest.approx(max(1 - length, 0) ** 2, abs=1e-3)


@pytest.mark.parametrize("length", [0.7, 1.5, 10.0])
def test_a_steady_loss_ends_at_a_limit(length):
    (left,) = integrated(
        lambda values, _: [-1.0 * (values[0] > 0)], [ONE], length, [BETWEEN]
    ).values
    assert left[0, 0] == pytest.approx(max(1 - length, 0), abs=1e-12)


@pytest.mark.parametrize("length", [1.0, 60.0, 500.0])
def test_a_state_that_another_drives_fades_with_it(length):
    """As bodies that cool: b' = 0.1 a − 2 b from 0, while a decays."""

    def rates(values, *_):
        return [-values[0], 0.1 * values[0] - 2 * values[1]]

    positive = Kept("a", "a test", 0.0)
    a, b = integrated(rates, [ONE, 0 * ONE], length, [positive, positive]).values
    assert a[0, 0] == pytest.approx(np.exp(-length), abs=1e-6)
    assert b[0, 0] == pytest.approx(0.1 * (np.exp(-length) - np.exp(-2 * length)), abs=1e-6)


@pytest.mark.parametrize("length", [1.0, 35.0, 1e3, 1e5])
def test_a_state_that_goes_on_beyond_its_limit_is_told_at_once(length):
    asked = []

    def rates(values, passed):
        asked.append(passed)
        return [ONE]

    with pytest.raises(BadValues, match="beyond its limits of 0 to 1"):
        integrated(rates, [0.5 * ONE], length, [BETWEEN])
    assert len(asked) < 2000


LENGTHS = [1e-3, 0.1, 1.0, 3.0, 30.0, 1e4]
FREE = Kept("a", "a test", 0.0)


@pytest.mark.parametrize("length", LENGTHS)
@pytest.mark.parametrize(
    ("first", "rates", "state", "total"),
    [
        # Running-in by the distance slid, five times as fast at first.
        (0.0, lambda y: (ONE, 1 + 4 * np.exp(-y)), lambda s: s, lambda s: s - 4 * np.expm1(-s)),
        # A bath, and what follows it.
        (0.0, lambda y: (1 - y, y), lambda s: -np.expm1(-s), lambda s: s + np.expm1(-s)),
        # A film that grows out of itself.
        (
            0.01,
            lambda y: (y * (1 - y), y),
            lambda s: 0.01 / (0.01 + 0.99 * np.exp(-s)),
            lambda s: s + np.log(0.01 + 0.99 * np.exp(-s)),
        ),
    ],
    ids=["running-in", "bath", "growth"],
)
def test_state_and_sum_follow_the_closed_form(first, rates, state, total, length):
    found = integrated(
        lambda values, _: [*rates(values[0])], [first * ONE], length, [FREE], ONE_SUM
    )
    (last,), (summed,) = found.values, found.sums
    assert last[0, 0] == pytest.approx(state(length), rel=3e-5, abs=0)
    assert summed[0, 0] == pytest.approx(total(length), rel=3e-5, abs=0)


@pytest.mark.parametrize("length", LENGTHS[:-1])
def test_debris_that_stays_bears_part_of_the_load_that_wears(length):
    def rates(values, *_):
        return [np.exp(-values[0]), np.exp(-values[0])]

    found = integrated(rates, [0 * ONE], length, [FREE], ONE_SUM)
    (last,), (summed,) = found.values, found.sums
    assert last[0, 0] == pytest.approx(np.log1p(length), rel=3e-5, abs=0)
    assert summed[0, 0] == pytest.approx(np.log1p(length), rel=3e-5, abs=0)


@pytest.mark.parametrize("length", [30.0, 1e4])
def test_debris_comes_to_where_it_flows_off_as_it_comes(length):
    (last,) = integrated(
        lambda values, _: [2 * np.exp(-values[0]) - values[0]], [0 * ONE], length, [FREE]
    ).values
    assert last[0, 0] == pytest.approx(float(lambertw(2).real), rel=3e-5)


def test_the_transpose_is_the_derivative():
    begin = [np.array([[0.2, 1.0, 3.0]]), np.array([[0.0, 0.5, 2.0]])]
    seeds = [
        np.array([[1.0, -2.0, 0.5]]),
        np.array([[0.3, 1.0, -1.0]]),
        np.array([[2.0, 1.0, 1.0]]),
    ]
    limits, at, asked = [FREE, FREE], {}, list[float]()

    def along(number):
        def rates(values, *_):
            a, b = values
            found = [number - a - 0.2 * a * b, a - 4 * b, np.exp(-a) * b]
            at[id(found)] = found, a, b
            return found

        return rates

    plan = integrated(along(1.5), begin, 5.0, limits, ONE_SUM).plan
    assert len(plan.parts) > 1

    def parts(start, number):
        rates = along(number)
        return retraced(rates, start, rates(start, 0.0), 5.0, limits, ONE_SUM, plan.parts)

    def objective(start, number):
        done = parts(start, number)
        ends = [*done[-1].end[:2], sum(part.end[2] for part in done)]
        return sum(float(np.sum(seed * end)) for seed, end in zip(seeds, ends, strict=True))

    def behind(found, given):
        (_, a, b), (of_a, of_b, of_sum) = at[id(found)], given
        asked.append(float(np.sum(of_a)))
        by_a = -(1 + 0.2 * b) * of_a + of_b - np.exp(-a) * b * of_sum
        return [by_a, -0.2 * a * of_a - 4 * of_b + np.exp(-a) * of_sum]

    found = transposed(parts(begin, 1.5), seeds[:2], [(Sum(), seeds[2])], behind).states
    for state in (0, 1):
        for point in range(3):
            by = np.zeros((1, 3))
            by[0, point] = 1e-5
            ends = [[*begin], [*begin]]
            ends[0][state], ends[1][state] = begin[state] + by, begin[state] - by
            higher, lower = (objective(end, 1.5) for end in ends)
            needed = (higher - lower) / 2e-5
            assert found[state][0, point] == pytest.approx(needed, rel=1e-6, abs=1e-8)
    needed = (objective(begin, 1.5 + 1e-5) - objective(begin, 1.5 - 1e-5)) / 2e-5
    assert sum(asked) == pytest.approx(needed, rel=1e-6)
