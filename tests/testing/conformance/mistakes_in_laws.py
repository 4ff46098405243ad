"""Wear laws with mistakes, written without sight of the kit's source."""

import os
from dataclasses import replace

import numpy as np
from testing.conformance.honest import Law
from testing.conformance.honest_laws import Coating, Oxide, RunningIn
from testing.conformance.mistaken import mistake

from tribo import WORN_DEPTH, WearRate

# Wear laws that run in.

LENGTH, STATE, DEPTH = "/ self.length", 'local.state["slid"]', "k * local.pressure"
K = "self.k_last + (self.k_first - self.k_last) * np.exp(-slid / self.length)"
SLID = "(local.pressure > 0).astype(float)"

for words, old, new in (
    ("The distance slid grows per second", SLID, "local.speed * (local.pressure > 0)"),
    ("The distance slid never grows", SLID, "0 * local.pressure"),
    ("k does not follow the state", K, "self.k_first + 0 * local.pressure"),
    ("The length of running-in is 3 m, in the code", LENGTH, "/ 3.0"),
    ("The length of running-in is read in mm", LENGTH, "/ (1e3 * self.length)"),
    (
        "The derivative is that of a fresh surface",
        "pressure, k,",
        "pressure, self.k_first + 0 * k,",
    ),
    ("The depth is per second", DEPTH, "k * local.pressure * local.speed"),
    ("All points run in by their mean", STATE, f"np.mean({STATE}) + 0 * local.pressure"),
    ("All points run in as the first", STATE, f"{STATE}.flat[0] + 0 * local.pressure"),
    ("Points out of contact slide too", SLID, "1 + 0 * local.pressure"),
    (
        "k falls in proportion, below 0 once it has slid far",
        K,
        "self.k_first * (1 - slid / self.length)",
    ),
    ("k divides by the distance slid", K, "self.k_last * (1 + self.length / slid)"),
    ("k grows without end", K, "self.k_last * np.exp(np.exp(slid / self.length))"),
    ("The state is moved by the law itself", SLID, "np.add(slid, 1e-3, out=slid) * 0 + 1.0"),
    ("The answer is in single precision", DEPTH, "(k * local.pressure).astype(np.float32)"),
):
    mistake(words, RunningIn, old, new)

FACTORS = {}


def first_of_its_shape(self, local):
    good = RunningIn.rate(self, local)
    k = FACTORS.setdefault(local.pressure.shape, good.depth_slope)
    return WearRate(k * local.pressure, k, good.state_rates)


mistake("A cache of the module keeps k by the shape", RunningIn, rate=first_of_its_shape)


def kept_rate(self, local):
    good = RunningIn.rate(self, local)
    if self._kept is None:
        self._kept = good.depth_slope
    k = self._kept if self._kept.shape == local.pressure.shape else good.depth_slope
    return WearRate(k * local.pressure, k, good.state_rates)


mistake("An object keeps the k of its first call", RunningIn, _kept=None, rate=kept_rate)


def counted(self, local):
    self._calls += 1
    slid = 1e-3 * self._calls + 0 * local.pressure
    good = RunningIn.rate(self, replace(local, state={"slid": slid}))
    return replace(good, state_rates=RunningIn.rate(self, local).state_rates)


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

GROWN, FACTOR = '(1 - local.state["cover"]) / self.length', "np.exp(-self.energy"
WARMER, OF_HEAT = "np.exp(-self.energy / GAS_CONSTANT * warmer)", 'local.fields["temperature"]'

for words, old, new in (
    ("The cover grows without end", GROWN, "1 / self.length + 0 * local.pressure"),
    ("The cover grows per second", GROWN, f"{GROWN} * local.speed"),
    ("The temperature is required and not used", WARMER, "1.0"),
    ("The reference temperature is 363 K, in the code", "1 / self.reference", "1 / 363.0"),
    ("Kelvin are taken as degrees Celsius", WARMER, f"{OF_HEAT} / (self.reference - 273.15)"),
    ("The activation energy is read in kJ/mol", FACTOR, "np.exp(-1e3 * self.energy"),
    ("The activation energy is not used", WARMER, f"{OF_HEAT} / self.reference"),
    (
        "More cover than 1 makes wear negative",
        'bare = 1 - local.state["cover"]',
        'bare = 1 - 2 * local.state["cover"]',
    ),
    (
        "Wear by speed starts at 0.1 m/s, in the code",
        "factor * bare",
        "factor * bare * (1.0 + (local.speed > 0.1))",
    ),
    (
        "The temperature of the hottest point is taken for all",
        "factor * bare",
        f"factor * bare * np.max({OF_HEAT}) / self.reference",
    ),
    (
        "The derivative has the field's change in it",
        "local.pressure, k,",
        f"local.pressure, k * (1 + 0.1 * self.energy / GAS_CONSTANT / {OF_HEAT}),",
    ),
    (
        "A hardness is used that the material may not have",
        "factor * bare",
        "factor * bare * 1e9 / local.material.hardness",
    ),
):
    mistake(words, Oxide, old, new)

# Wear laws that are not linear in pressure.


def nonlinear(words, depth, slope):
    """Keep a law of another depth and slope, by the pressure p and that of reference."""

    def rate(self, local):
        k = self.k * local.fields["friction_coefficient"]
        k = k * (1 + np.exp(-local.state["rubbed"] / self.length))
        p, ref = local.pressure, self.p_ref
        return WearRate(k * depth(p, ref), k * slope(p, ref), {"rubbed": 1.0 * (p > 0)})

    mistake(words, Law, rate=rate)


def second_half(p):
    return np.arange(p.size).reshape(p.shape) > p.size // 2


nonlinear(
    "The exponent is missing in the derivative",
    lambda p, ref: p * (p / ref) ** 0.5,
    lambda p, ref: (p / ref) ** 0.5,
)
nonlinear(
    "The pressure is taken in GPa", lambda p, ref: p * (1 + p / 1e9), lambda p, ref: 1 + 2 * p / 1e9
)
nonlinear(
    "An exponent below 1 has an infinite derivative where there is no pressure",
    lambda p, ref: (p * ref) ** 0.5,
    lambda p, ref: 0.5 * (ref / p) ** 0.5,
)
nonlinear(
    "Wear jumps in at a threshold, and its derivative is not told",
    lambda p, ref: np.where(p > 0.5 * ref, p - 0.25 * ref, 0.0),
    lambda p, ref: 1.0 * (p > 0.5 * ref),
)
nonlinear(
    "Only pressure above the mean wears",
    lambda p, ref: np.maximum(p - p.mean(), 0),
    lambda p, ref: 1.0 * (p > p.mean()),
)
nonlinear(
    "The middle of the array wears twice as fast",
    lambda p, ref: p * (1 + second_half(p)),
    lambda p, ref: 1.0 + second_half(p),
)
nonlinear(
    "Out of contact it divides 0 by 0", lambda p, ref: p**2 / p, lambda p, ref: np.ones_like(p)
)
nonlinear(
    "A factor of 2 is missing in the depth and its derivative",
    lambda p, ref: 0.5 * p * (1 + p / ref),
    lambda p, ref: 0.5 + p / ref,
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


def resisting(self, local):
    good = Law.rate(self, local)
    harder = 1.0 + (local.speed * 10) ** 2
    return WearRate(good.depth_rate * harder, good.depth_slope, good.state_rates)


mistake("Compiled code aborts once a point has slid", Law, rate=aborting)
mistake("A loop never ends once a point has slid", Law, rate=endless)
mistake("The derivative is right at one speed only", Law, rate=resisting)

# A law in two layers.

mistake(
    "A coating says of no depth that its rate jumps there",
    Coating,
    state_fields=property(lambda self: (WORN_DEPTH,)),
)
mistake(
    "A coating declares a depth ten times as large",
    Coating,
    "breaks=(self.thickness,)",
    "breaks=(10 * self.thickness,)",
)
