"""Rates integrated over an increment, against closed forms."""

import numpy as np
import pytest

from tribo.core.errors import BadValues, PluginError
from tribo.integration.division import integrated
from tribo.integration.kept import Kept, Sum

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
    with pytest.raises(BadValues, match=r"\('a' of a test, 'a' of a test\) change too often"):
        integrated(turning(0.05), [ONE, 0 * ONE], 3.0, [ANY, ANY])


@pytest.mark.parametrize("at", [1e-7, 1e-4, 0.3])
def test_a_rate_that_jumps_is_followed_wherever_it_does(at):
    def rates(values, passed):
        return [ONE, ONE if passed < at else 3 * ONE]

    (total,) = integrated(rates, [0 * ONE], 1.0, [ANY], ONE_SUM).sums
    assert total[0, 0] == pytest.approx(3 - 2 * at, abs=3e-4)


BETWEEN = Kept("a", "a test", 0.0, 1.0)


@pytest.mark.parametrize("length", [1.0, 35.0, 1e3, 1e5])
def test_a_state_that_goes_on_beyond_its_limit_is_told_at_once(length):
    asked = []

    def rates(values, passed):
        asked.append(passed)
        return [ONE]

    with pytest.raises(PluginError, match="leaves its limits of 0 to 1"):
        integrated(rates, [0.5 * ONE], length, [BETWEEN])
    assert len(asked) < 2000


@pytest.mark.parametrize("length", [1.5, 3.0, 100.0])
@pytest.mark.parametrize(("place", "within"), [(None, 1e-3), ("a place", 3e-5)])
@pytest.mark.parametrize(("breaks", "after"), [((), 0.0), ((0.4,), -0.5)])
def test_a_sum_whose_rate_follows_a_state_to_a_break_is_right(length, place, within, breaks, after):
    """A state falls from 1, below a break more slowly, to its limit; what is summed is 1 more."""
    kept = Kept("a", "a test", least=0.0, breaks=breaks, place="a place")
    low = breaks[0] if breaks else 0.0

    def rates(values, passed):
        falls = np.where(values[0] >= low, -1.0, after)
        return [np.where(values[0] > 0, falls, 0.0), 1 + values[0]]

    first = 1 - low
    rest = min(length - first, low / -after) if after else 0.0
    exact = length + 0.5 * (1 + low) * first + (low + 0.5 * after * rest) * rest
    found = integrated(rates, [ONE], length, [kept], [Sum(place)])
    assert found.sums[0] == pytest.approx(exact, rel=within)


LAYERED = Kept("a", "a test", breaks=(0.3, 0.5, 2.0))


def layers(values, _):
    """Depths whose rates are 1, 4, 0.5 and 2 in the layers, and three times that in one cell."""
    rates = np.array([1.0, 4.0, 0.5, 2.0])
    rate = rates[np.searchsorted(LAYERED.breaks, values[0], side="right")] * [[1.0, 3.0]]
    return [rate, rate]


@pytest.mark.parametrize("length", [0.2, 0.34, 1.0, 40.0])
def test_layers_are_passed_to_the_last_digit(length):
    asked = []

    def rates(values, passed):
        asked.append(passed)
        return layers(values, passed)

    start = [np.zeros((1, 2))]
    found = integrated(rates, start, length, [LAYERED], [Sum("")])
    for cell, speed in enumerate((1.0, 3.0)):
        at = np.array([0, 0.3, 0.3 + 0.2 / 4, 0.35 + 1.5 / 0.5, 1e9]) / speed
        exact = np.interp(length, at, [0, 0.3, 0.5, 2.0, 2.0 + 2 * (1e9 - 3.35)])
        assert found.values[0][0, cell] == pytest.approx(exact, rel=1e-12, abs=0)
        assert found.sums[0][0, cell] == pytest.approx(exact, rel=1e-12, abs=0)
    passes = dict(zip(range(3), np.array([0.3, 0.35, 3.35]) / 3 / length, strict=True))
    assert found.passed == {
        (0, each): pytest.approx(share, rel=1e-12, abs=0)
        for each, share in passes.items()
        if share < 1
    }
    assert len(asked) < 60


@pytest.mark.parametrize("length", [0.4, 0.45, 0.5, 0.6, 3.0, 40.0])
def test_what_relaxes_under_a_layer_begins_when_that_is_passed(length):
    """Its rate is 4, three times more at first; above the layer nothing but the depth goes on.

    After three quarters, two thirds or half of the length all rows agree by chance.
    """

    def rates(values, _):
        depth, worked = values
        below = depth >= 0.3
        rate = np.where(below, 4 * (1 + 3 * np.exp(-worked)), 1.0)
        return [rate, 1.0 * below, rate]

    found = integrated(rates, [0 * ONE, 0 * ONE], length, [LAYERED, ANY], [Sum("")])
    left = length - 0.3
    exact = 0.3 + 4 * left - 12 * np.expm1(-left)
    assert found.values[0][0, 0] == pytest.approx(exact, rel=1e-3)
    assert found.sums[0][0, 0] == pytest.approx(exact, rel=1e-3)
    assert found.passed[0, 0] == pytest.approx(0.3 / length, rel=1e-9)


def test_a_state_that_turns_at_a_break_passes_it_downwards():
    thermostat = Kept("a", "a test", breaks=(1.0,))

    def rates(values, _):
        return [np.where(values[0] < 1, -0.5, -2.0)]

    (found,) = integrated(rates, [3 * ONE], 4.0, [thermostat]).values
    assert found[0, 0] == pytest.approx(1 - 0.5 * 3, rel=1e-12, abs=0)


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
