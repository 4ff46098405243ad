"""Rates integrated over an increment, against closed forms."""

import numpy as np
import pytest

from tribo.core.errors import BadValues
from tribo.stepping.extrapolation import integrated
from tribo.stepping.relaxation import Limits

ANY = Limits(-np.inf, np.inf, "'a' of a test")
ONE = np.ones((1, 1))


def turning(period):
    """A state that oscillates undamped, a' = 2π b / λ and b' = −2π a / λ, from 1 and 0."""
    turns = 2 * np.pi / period

    def rates(values, passed, _):
        return [turns * values[1], -turns * values[0]]

    return rates


def test_an_oscillation_over_many_periods_is_refused_and_never_unstable():
    with pytest.raises(BadValues, match=r"\('a' of a test, 'a' of a test\) changes too often"):
        integrated(turning(0.05), [ONE, 0 * ONE], 3.0, [ANY, ANY])


def test_an_oscillation_over_some_periods_is_followed():
    (a, b), _, _ = integrated(turning(1.0), [ONE, 0 * ONE], 1.25, [ANY, ANY])
    assert a[0, 0] == pytest.approx(0, abs=1e-3)
    assert b[0, 0] == pytest.approx(-1, abs=1e-3)


def test_a_rate_that_is_zero_at_both_ends_is_integrated():
    def rates(values, passed, _):
        return [ONE, passed * (1 - passed) * (1 + 1e-4 * passed**2) * ONE]

    _, (total,), _ = integrated(rates, [0 * ONE], 1.0, [ANY])
    assert total[0, 0] == pytest.approx(1 / 6 + 1e-4 / 20, rel=3e-5)


@pytest.mark.parametrize("at", [1e-7, 1e-4, 0.3])
def test_a_rate_that_jumps_is_followed_wherever_it_does(at):
    def rates(values, passed, step):
        return [ONE, ONE if passed < at else 3 * ONE]

    _, (total,), _ = integrated(rates, [0 * ONE], 1.0, [ANY])
    assert total[0, 0] == pytest.approx(3 - 2 * at, abs=3e-4)


@pytest.mark.parametrize("length", [0.5, 3.5, 10.0, 1000.0])
def test_a_state_relaxes_alike_with_limits_and_without_however_long_the_increment(length):
    def decay(values, passed, step):
        return [-values[0]]

    def slower(values, passed, step):
        return [-(values[0] ** 2)]

    between = Limits(0.0, np.inf, "'a' of a test")
    (decayed,), _, _ = integrated(decay, [ONE], length, [between])
    (slowed,), _, _ = integrated(slower, [ONE], length, [between])
    assert decayed[0, 0] == pytest.approx(np.exp(-length), rel=1e-9, abs=1e-300)
    assert slowed[0, 0] == pytest.approx(1 / (1 + length), rel=1e-3)


BETWEEN = Limits(0.0, 1.0, "'a' of a test")


@pytest.mark.parametrize("length", [2.0, 3.5, 7.1, 70.0, 3e5])
def test_a_state_that_begins_at_a_limit_leaves_it_however_long_the_increment(length):
    (grown,), _, _ = integrated(lambda values, *_: [1 - values[0]], [0 * ONE], length, [BETWEEN])
    assert grown[0, 0] == pytest.approx(-np.expm1(-length), rel=1e-6)


@pytest.mark.parametrize("length", [0.7, 1.5, 12.0, 1000.0])
def test_a_state_may_come_to_its_limit_within_the_increment(length):
    (left,), _, _ = integrated(
        lambda values, *_: [-2 * np.sqrt(np.maximum(values[0], 0))], [ONE], length, [BETWEEN]
    )
    assert left[0, 0] == pytest.approx(max(1 - length, 0) ** 2, abs=1e-3)


@pytest.mark.parametrize("length", [0.7, 1.5, 10.0])
def test_a_steady_loss_ends_at_a_limit(length):
    (left,), _, _ = integrated(
        lambda values, *_: [-1.0 * (values[0] > 0)], [ONE], length, [BETWEEN]
    )
    assert left[0, 0] == pytest.approx(max(1 - length, 0), abs=1e-3)


@pytest.mark.parametrize("length", [1.0, 60.0, 500.0])
def test_a_state_that_another_drives_fades_with_it(length):
    """As bodies that cool: b' = 0.1 a − 2 b from 0, while a decays."""

    def rates(values, *_):
        return [-values[0], 0.1 * values[0] - 2 * values[1]]

    positive = Limits(0.0, np.inf, "'a' of a test")
    (a, b), _, _ = integrated(rates, [ONE, 0 * ONE], length, [positive, positive])
    assert a[0, 0] == pytest.approx(np.exp(-length), abs=1e-6)
    assert b[0, 0] == pytest.approx(0.1 * (np.exp(-length) - np.exp(-2 * length)), abs=1e-6)


@pytest.mark.parametrize("length", [1.0, 35.0, 1e3, 1e5])
def test_a_state_that_goes_on_beyond_its_limit_is_told_at_once(length):
    asked = []

    def rates(values, passed, step):
        asked.append(passed)
        return [ONE]

    with pytest.raises(BadValues, match="beyond its limits of 0 to 1"):
        integrated(rates, [0.5 * ONE], length, [BETWEEN])
    assert len(asked) < 2000


def test_a_rate_that_jumps_is_followed_beside_depths_in_layers():
    """Rates are the means over a part, but for what a state makes jump within it."""

    def rates(values, passed, step):
        return [1 - values[0], ONE, (1.0 if values[0][0, 0] > 0.5 else 0.1) * ONE]

    limits = [BETWEEN, Limits(-np.inf, np.inf, "a depth", relaxes=False)]
    _, (total,), _ = integrated(rates, [0 * ONE, 0 * ONE], 2.0, limits, layered=[False])
    assert total[0, 0] == pytest.approx(2 - 0.9 * np.log(2), rel=3e-3)
