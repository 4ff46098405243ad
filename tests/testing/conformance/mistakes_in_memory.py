"""Models that remember beside their state, or not by the point, or without an end.

They were written without sight of the checks.
"""

import time
from dataclasses import replace

import numpy as np
from testing.conformance.honest_effects import Debris, Spreading, Tribofilm
from testing.conformance.honest_laws import Coating, Incubation, Lubricated, Oxide, RunningIn
from testing.conformance.mistaken import mistake

# Memory beside the state.


def by_a_factor(words, factor, **parts):
    """Keep a law whose k has a factor that the law finds beside its state."""

    def rate(self, local):
        good, more = RunningIn.rate(self, local), factor(self, local)
        return replace(good, depth_rate=more * good.depth_rate, depth_slope=more * good.depth_slope)

    mistake(words, RunningIn, rate=rate, **parts)


def of_calls(self, local):
    self._calls += 1
    return 1 + 1 / self._calls


def of_the_largest(self, local):
    self._largest = max(self._largest, float(local.pressure.max()))
    return local.pressure.max() / self._largest


def of_the_clock(self, local):
    self._born = self._born or time.monotonic()
    return 1 + 1e-3 * (time.monotonic() - self._born)


by_a_factor("k falls with the number of calls too", of_calls, _calls=0)
by_a_factor("k goes by the largest pressure of any call", of_the_largest, _largest=0.0)
by_a_factor("k ages by the clock of the machine", of_the_clock, _born=None)


def in_a_buffer(self, values):
    """Return values in an array that the next call overwrites."""
    if self._out is None or self._out.shape != values.shape:
        self._out = np.empty_like(values)
    self._out[:] = values
    return self._out


def depth_in_a_buffer(self, local):
    good = RunningIn.rate(self, local)
    return replace(good, depth_rate=in_a_buffer(self, good.depth_rate))


def friction_in_a_buffer(self, contact):
    (friction,) = Tribofilm.fields(self, contact).values()
    kept = in_a_buffer(self, next(iter(friction.values())))
    return {"friction_coefficient": dict.fromkeys(contact.materials, kept)}


mistake(
    "The depth lies in a buffer that the next call overwrites",
    RunningIn,
    _out=None,
    rate=depth_in_a_buffer,
)
mistake(
    "Friction lies in a buffer that the next call overwrites",
    Tribofilm,
    _out=None,
    fields=friction_in_a_buffer,
)

DISTANCE = "contact.distance / self.length"
FADED, FORMED = "film / self.life", "contact.speed * bare / self.length"
SHARE, THICK = '-np.expm1(-contact.state["debris"] / self.cover)', 'contact.state["debris"]'

mistake(
    "Debris carries more with the distance slid, beside its state",
    Debris,
    "/ self.cover",
    f"/ self.cover * (1 + {DISTANCE})",
)
mistake(
    "A film fades by the distance since the start of the run",
    Tribofilm,
    FADED,
    f"{FADED} * np.exp(-{DISTANCE})",
)
mistake(
    "A film forms less with the distance, beside its state",
    Tribofilm,
    FORMED,
    f"{FORMED} / (1 + {DISTANCE})",
)


def faded_since(self, contact):
    step = max(contact.time - self._last, 0.0) or self.life
    self._last = contact.time
    return -contact.state["film"] * np.expm1(-step / self.life) / step


mistake(
    "A film fades over the time since the last call",
    Tribofilm,
    FADED,
    "self.faded_since(contact)",
    _last=0.0,
    faded_since=faded_since,
)


def more_each_call(self):
    self._calls += 1
    return 1 - 0.5**self._calls


def damped(self, now):
    same = self._share is not None and self._share.shape == now.shape
    self._share = 0.7 * now + 0.3 * self._share if same else now
    return self._share


mistake(
    "Debris carries more from call to call",
    Debris,
    SHARE,
    f"{SHARE} * self.more()",
    _calls=0,
    more=more_each_call,
)
mistake(
    "The share is damped from call to call",
    Debris,
    SHARE,
    f"self.damped({SHARE})",
    _share=None,
    damped=damped,
)

# States that lie elsewhere.

STATE, SLID = 'slid = local.state["slid"]', "(local.pressure > 0).astype(float)"

for words, honest, old, new in (
    (
        "The state is read transposed in a square window",
        RunningIn,
        STATE,
        f"slid = square({STATE[7:]})",
    ),
    ("The state is read from the other end of x", RunningIn, STATE, f"{STATE}[..., ::-1, :]"),
    ("The state is read from the other side of y", RunningIn, STATE, f"{STATE}[..., ::-1]"),
    (
        "The state is read a cell behind",
        RunningIn,
        STATE,
        f"slid = np.roll({STATE[7:]}, 1, axis=-2)",
    ),
    ("The state is sorted along y", RunningIn, STATE, f"slid = np.sort({STATE[7:]}, axis=-1)"),
    (
        "The state of the first position holds at all",
        RunningIn,
        STATE,
        f"{STATE}[:1] + 0 * local.pressure",
    ),
    (
        "The state is that of the middle row",
        RunningIn,
        STATE,
        f"{STATE}[..., local.pressure.shape[-2] // 2, :][..., None, :] + 0 * local.pressure",
    ),
    (
        "The slid distance is given transposed in a square window",
        RunningIn,
        SLID,
        f"square({SLID})",
    ),
    (
        "Debris carries where it lies transposed, in a square window",
        Debris,
        SHARE,
        f"-np.expm1(-square({THICK}) / self.cover)",
    ),
    (
        "Debris carries on the other side of y",
        Debris,
        SHARE,
        f"-np.expm1(-{THICK}[:, ::-1] / self.cover)",
    ),
    (
        "Debris leaves where it lies mirrored along x",
        Debris,
        "thickness / self.length",
        "thickness[::-1] / self.length",
    ),
    ("A film forms transposed in a square window", Tribofilm, FORMED, f"square({FORMED})"),
    (
        "A film fades by its mean along y",
        Tribofilm,
        FADED,
        "np.mean(film, axis=1, keepdims=True) / self.life + 0 * contact.pressure",
    ),
):
    mistake(words, honest, old, new)

# Growth without an end, and states beyond their limits.

K = "self.k_last + (self.k_first - self.k_last) * np.exp(-slid / self.length)"
LIMIT = "worn < self.thickness"
RATE = "contact.speed * (self.source(contact) - leaving)"

for words, honest, old, new in (
    (
        "k grows in proportion to the distance, without end",
        RunningIn,
        K,
        "self.k_last * (1 + slid / (500 * self.length))",
    ),
    ("k grows by e over a kilometre", RunningIn, K, f"({K}) * np.exp(slid / 500 / self.length)"),
    (
        "k falls in proportion, below 0 after a kilometre",
        RunningIn,
        K,
        "self.k_first * (1 - slid / (500 * self.length))",
    ),
    (
        "Worn depth wears the faster, without end",
        Coating,
        "self.k, self.below)",
        "self.k, self.below) * (1 + worn / self.thickness)",
    ),
    (
        "Debris makes debris, by a thousandth of its length",
        Debris,
        RATE,
        "contact.speed * (self.source(contact) + 1e-3 * thickness / self.length)",
    ),
    (
        "Debris goes on leaving when none is left",
        Debris,
        "thickness / self.length",
        "self.cover / self.length",
    ),
    (
        "A film is rubbed off at one rate, though none is left",
        Lubricated,
        "-left / self.length",
        "-1 / self.length",
    ),
    (
        "Oxide grows out of contact",
        Oxide,
        'np.where(local.pressure > 0, (1 - local.state["cover"]) / self.length, 0.0)',
        '(1 - local.state["cover"]) / self.length',
    ),
    (
        "Spreading debris piles up by its square",
        Spreading,
        "self.leaves * height / contact.track",
        "-1e-4 * height**2 / (self.cover * contact.track)",
    ),
    # Breaks.
    (
        "At the break itself the rate is that below it",
        Incubation,
        "< self.length",
        "<= self.length",
    ),
    (
        "Incubation ends at half the length, which no break tells",
        Incubation,
        "< self.length",
        "< 0.5 * self.length",
    ),
    (
        "A coating is worn through at its thickness of all points' mean",
        Coating,
        LIMIT,
        "worn.mean() + 0 * worn < self.thickness",
    ),
    (
        "The worn depth is said to grow by half of what wears",
        Coating,
        '{"worn_depth": k',
        '{"worn_depth": 0.5 * k',
    ),
):
    mistake(words, honest, old, new)
mistake("Oxide begins at more than all", Oxide, initial_state=lambda self: {"cover": 1.5})
