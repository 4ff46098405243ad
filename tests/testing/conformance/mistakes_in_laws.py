"""Wear laws with mistakes, written without sight of the kit's source."""

import os
from dataclasses import replace

import numpy as np
from testing.conformance.honest import Law
from testing.conformance.mistaken import mistake
from testing.conformance.models import GAS_CONSTANT, Coating, Oxide, RunningIn

from tribo import WORN_DEPTH, WearRate


def touching(local):
    return (local.pressure > 0).astype(float)


# Wear laws that run in.


def running_in(words, k=None, depth=None, slope=None, slid=None):
    """Keep a running-in law of which k, the depth, its slope or the state's rate is wrong."""

    def rate(self, local):
        now = (k or RunningIn.k)(self, local)
        deep = depth(self, local, now) if depth else now * local.pressure
        steep = slope(self, local, now) if slope else now + 0 * local.pressure
        return WearRate(deep, steep, {"slid": (slid or RunningIn.slid)(self, local)})

    mistake(words, RunningIn, rate=rate)


def decay(self, slid, length):
    return self.k_last + (self.k_first - self.k_last) * np.exp(-slid / length)


running_in(
    "The distance slid grows per second", slid=lambda s, local: touching(local) * local.speed
)
running_in("The distance slid never grows", slid=lambda s, local: 0 * local.pressure)
running_in("k does not follow the state", k=lambda s, local: s.k_first + 0 * local.pressure)
running_in(
    "The length of running-in is 3 m, in the code", k=lambda s, c: decay(s, c.state["slid"], 3.0)
)
running_in(
    "The length of running-in is read in mm",
    k=lambda s, local: decay(s, local.state["slid"], 1e3 * s.length),
)
running_in("The derivative is that of a fresh surface", slope=lambda s, local, k: s.k_first + 0 * k)
running_in("The depth is per second", depth=lambda s, local, k: k * local.pressure * local.speed)
running_in(
    "All points run in by their mean",
    k=lambda s, local: decay(s, np.mean(local.state["slid"]), s.length) + 0 * local.pressure,
)
running_in(
    "All points run in as the first",
    k=lambda s, local: decay(s, local.state["slid"].flat[0], s.length) + 0 * local.pressure,
)
running_in("Points out of contact slide too", slid=lambda s, local: 1 + 0 * local.pressure)
running_in(
    "k falls in proportion, below 0 once it has slid far",
    k=lambda s, local: s.k_first * (1 - local.state["slid"] / s.length),
)
running_in(
    "k divides by the distance slid",
    k=lambda s, local: s.k_last * (1 + s.length / local.state["slid"]),
)
running_in(
    "k grows without end",
    k=lambda s, local: s.k_last * np.exp(np.exp(local.state["slid"] / s.length)),
)
running_in(
    "The state is moved by the law itself",
    slid=lambda s, local: np.add(local.state["slid"], 1e-3, out=local.state["slid"]) * 0 + 1.0,
)
running_in(
    "The answer is in single precision",
    depth=lambda s, local, k: (k * local.pressure).astype(np.float32),
)

FACTORS = {}


def first_of_its_shape(self, local):
    shape = local.pressure.shape
    return FACTORS.setdefault(shape, RunningIn.k(self, local))


running_in("A cache of the module keeps k by the shape", k=first_of_its_shape)


def once(self, local):
    if self._kept is None:
        self._kept = RunningIn.k(self, local)
    return self._kept if self._kept.shape == local.pressure.shape else RunningIn.k(self, local)


def kept_rate(self, local):
    k = once(self, local)
    return WearRate(k * local.pressure, k, {"slid": touching(local)})


mistake("An object keeps the k of its first call", RunningIn, _kept=None, rate=kept_rate)


def counted(self, local):
    self._calls += 1
    k = decay(self, 1e-3 * self._calls, self.length)
    return WearRate(k * local.pressure, k + 0 * local.pressure, {"slid": touching(local)})


mistake("Its calls are counted as the distance", RunningIn, _calls=0, rate=counted)


def scattered(self, local):
    good = RunningIn.rate(self, local)
    noise = 1 + 0.05 * np.random.default_rng().normal(size=local.pressure.shape)
    return WearRate(good.depth_rate * noise, good.depth_slope * noise, good.state_rates)


mistake("k scatters by fresh random numbers", RunningIn, rate=scattered)
mistake(
    "The initial state is that of another name",
    RunningIn,
    initial_state=lambda self: {"slide": 0.0},
)


# Wear under an oxide that grows, in a heat that it is told.


def oxide(words, **methods):
    mistake(words, Oxide, **methods)


oxide("The cover grows without end", grown=lambda s, local: 1 / s.length + 0 * local.pressure)
oxide(
    "The cover grows per second",
    grown=lambda s, local: (1 - local.state["cover"]) / s.length * local.speed,
)
oxide("The temperature is required and not used", factor=lambda s, local: 1.0)
oxide(
    "The reference temperature is 363 K, in the code",
    factor=lambda s, local: np.exp(
        -s.energy / GAS_CONSTANT * (1 / local.fields["temperature"] - 1 / 363.0)
    ),
)
oxide(
    "Kelvin are taken as degrees Celsius",
    factor=lambda s, local: local.fields["temperature"] / (s.reference - 273.15),
)
oxide(
    "The activation energy is read in kJ/mol",
    factor=lambda s, local: np.exp(
        -1e3 * s.energy / GAS_CONSTANT * (1 / local.fields["temperature"] - 1 / s.reference)
    ),
)
oxide(
    "The activation energy is not used",
    factor=lambda s, local: local.fields["temperature"] / s.reference,
)
oxide(
    "More cover than 1 makes wear negative",
    bare=lambda s, local: 1 - 2 * local.state["cover"],
)
oxide(
    "Wear by speed starts at 0.1 m/s, in the code",
    factor=lambda s, local: Oxide.factor(s, local) * (1.0 + (local.speed > 0.1)),
)
oxide(
    "The temperature of the hottest point is taken for all",
    factor=lambda s, local: (
        Oxide.factor(s, local) * np.max(local.fields["temperature"]) / s.reference
    ),
)


def with_heat_in_it(self, local):
    good = Oxide.rate(self, local)
    more = 1 + self.energy / GAS_CONSTANT / local.fields["temperature"] * 0.1
    return WearRate(good.depth_rate, good.depth_slope * more, good.state_rates)


oxide("The derivative has the field's change in it", rate=with_heat_in_it)


def body_of(self, local):
    good = Oxide.rate(self, local)
    softer = 1e9 / local.material.hardness
    return WearRate(good.depth_rate * softer, good.depth_slope * softer, good.state_rates)


oxide("A hardness is used that the material may not have", rate=body_of)

# Wear laws that are not linear in pressure.


def powered(words, rate):
    mistake(words, Law, rate=rate)


def nonlinear(depth, slope, rubbed=1.0):
    def rate(self, local):
        k = self.k * local.fields["friction_coefficient"]
        k = k * (1 + np.exp(-local.state["rubbed"] / self.length))
        p, ref = local.pressure, self.p_ref
        return WearRate(k * depth(p, ref), k * slope(p, ref), {"rubbed": rubbed * (p > 0)})

    return rate


def threshold(p, ref):
    return np.where(p > 0.5 * ref, p - 0.25 * ref, 0.0)


powered(
    "The exponent is missing in the derivative",
    nonlinear(lambda p, ref: p * (p / ref) ** 0.5, lambda p, ref: (p / ref) ** 0.5),
)
powered(
    "The pressure is taken in GPa",
    nonlinear(lambda p, ref: p * (1 + p / 1e9), lambda p, ref: 1 + 2 * p / 1e9),
)
powered(
    "An exponent below 1 has an infinite derivative where there is no pressure",
    nonlinear(lambda p, ref: (p * ref) ** 0.5, lambda p, ref: 0.5 * (ref / p) ** 0.5),
)
powered(
    "Wear jumps in at a threshold, and its derivative is not told",
    nonlinear(threshold, lambda p, ref: (p > 0.5 * ref).astype(float)),
)
powered(
    "Only pressure above the mean wears",
    nonlinear(lambda p, ref: np.maximum(p - p.mean(), 0), lambda p, ref: (p > p.mean()) * 1.0),
)
powered(
    "The middle of the array wears twice as fast",
    nonlinear(
        lambda p, ref: p * (1 + (np.arange(p.size).reshape(p.shape) > p.size // 2)),
        lambda p, ref: 1.0 + (np.arange(p.size).reshape(p.shape) > p.size // 2),
    ),
)
powered(
    "Out of contact it divides 0 by 0",
    nonlinear(lambda p, ref: p**2 / p, lambda p, ref: np.ones_like(p)),
)
powered(
    "A factor of 2 is missing in the depth and its derivative",
    nonlinear(lambda p, ref: 0.5 * p * (1 + p / ref), lambda p, ref: 0.5 + p / ref),
)


def aborting(self, local):
    if np.any(local.speed > 0.5) or local.state["rubbed"].max() > 1.0:
        os.abort()
    return Law.rate(self, local)


def endless(self, local):
    left = local.state["rubbed"].max() / self.length
    while left > 0.5:
        left = max(left * 0.5, 0.6)
    return Law.rate(self, local)


powered("Compiled code aborts once a point has slid", aborting)
powered("A loop never ends once a point has slid", endless)


def resisting(self, local):
    good = Law.rate(self, local)
    harder = 1.0 + (local.speed * 10) ** 2
    return WearRate(good.depth_rate * harder, good.depth_slope, good.state_rates)


powered("The derivative is right at one speed only", resisting)

# A law in two layers.

mistake(
    "A coating says of no depth that its rate jumps there",
    Coating,
    state_fields=property(lambda self: (WORN_DEPTH,)),
)
mistake(
    "A coating declares a depth ten times as large",
    Coating,
    state_fields=property(lambda self: (replace(WORN_DEPTH, breaks=(10 * self.thickness,)),)),
)
