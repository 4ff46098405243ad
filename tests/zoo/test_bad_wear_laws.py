"""Wear laws that answer nonsense from some step on, or from the start."""

import numpy as np
import pytest
from zoo_keeper import Zoo, expect_harmless, expect_one_message

from tribo import Field, WearLaw, WearRate

ZOO = Zoo()
bad = ZOO.bad


def bad_later(words):
    return ZOO.bad(words, saved=True)


class Law(WearLaw):
    """Good for 20 calls; `spoilt` is what it answers after them."""

    _calls: object = 0

    def rate(self, local):
        self._calls += 1
        k = np.full_like(local.pressure, 3e-16)
        good = WearRate(k * local.pressure, k, {f.name: k for f in self.state_fields})
        return self.spoilt(good, local) if self._calls > 20 else good


@bad_later("of body 'ball' gave a NoneType instead of a WearRate")
class AnswersNothing(Law):
    def spoilt(self, good, local):
        return None


@bad_later("gave a depth per metre that is not finite in")
class NotANumber(Law):
    def spoilt(self, good, local):
        return WearRate(good.depth_rate * np.nan, good.depth_slope)


@bad_later("gave a derivative that is not finite in")
class EndlessSlope(Law):
    def spoilt(self, good, local):
        return WearRate(good.depth_rate, good.depth_slope * np.inf)


@bad_later("gave a depth per metre that is not an array of shape")
class WrongShape(Law):
    def spoilt(self, good, local):
        return WearRate(good.depth_rate[1:], good.depth_slope)


@bad_later("gave a depth per metre that is not an array of shape")
class Words(Law):
    def spoilt(self, good, local):
        return WearRate("deep", good.depth_slope)


@bad_later("complex128")
class Complex(Law):
    def spoilt(self, good, local):
        return WearRate(good.depth_rate * 1j, good.depth_slope)


@bad_later("gave a negative depth per metre (-")
class Grows(Law):
    def spoilt(self, good, local):
        return WearRate(-good.depth_rate, good.depth_slope)


@bad_later("gave a depth per metre that is not 0 in")
class WearsUntouched(Law):
    def spoilt(self, good, local):
        return WearRate(3e-16 * (local.pressure + 1e8), good.depth_slope)


@bad_later("read-only")
class WritesIntoThePressure(Law):
    def spoilt(self, good, local):
        local.pressure[:] = 0


@bad_later("raised KeyError: 'oops'")
class Raises(Law):
    def spoilt(self, good, local):
        raise KeyError("oops")


@bad_later("raised SystemExit: 0")
class Leaves(Law):
    @staticmethod
    def spoilt(good, local):
        raise SystemExit(0)


@bad_later("gave a int as rates of its state")
class StateIsANumber(Law):
    def spoilt(self, good, local):
        return WearRate(good.depth_rate, good.depth_slope, 7)


class Slides(Law):
    state_fields = (Field("slid", "m", "Path slid."),)


@bad_later("gave a rate of 'slid' that is not an array of shape (32, 32): a str")
class StateInWords(Slides):
    def spoilt(self, good, local):
        return WearRate(good.depth_rate, good.depth_slope, {"slid": "far"})


@bad_later("gave no rate for its state field 'slid'")
class ForgetsItsState(Slides):
    def spoilt(self, good, local):
        return WearRate(good.depth_rate, good.depth_slope)


@bad("declares the state fields ['slid'], but starts with {}")
class StartsNowhere(Slides):
    def initial_state(self):
        return {}


@bad("gave an initial 'slid' that is not a finite number: nan")
class StartsNotANumber(Slides):
    def initial_state(self):
        return {"slid": np.nan}


@bad("raised TypeError: no material")
class CheckRaises(Law):
    def check(self, material):
        raise TypeError("no material")


@pytest.mark.filterwarnings("ignore:invalid value:RuntimeWarning")
@pytest.mark.parametrize("cls", ZOO.kept, ids=lambda cls: cls.__name__)
def test_it_ends_with_one_message(run, cls):
    expect_one_message(run(ZOO, cls), cls)


def test_none_harms_a_case_that_names_another(run):
    expect_harmless(run(ZOO))
