"""Models that remember beside their state, or not by the point, or without an end.

They were written without sight of the checks.
"""

import time
from dataclasses import replace

import numpy as np
from testing.conformance.mistaken import mistake
from testing.conformance.models import Coating, Debris, Oxide, RunningIn, Tribofilm
from testing.conformance.models_of_contact import Incubation, Lubricated, Spreading

from tribo import WORN_DEPTH, WearRate


def square(array):
    """Return an array transposed, where that has the same shape, as in a square window."""
    turned = np.swapaxes(array, -1, -2)
    return turned if turned.shape == array.shape else array


def law_of(k):
    """Return a `rate` of the running-in law by another specific wear rate."""

    def rate(self, local):
        now = k(self, local)
        return WearRate(now * local.pressure, now + 0 * local.pressure, {"slid": self.slid(local)})

    return {"rate": rate}


def by_state(change):
    """Return parts of the running-in law that sees a changed state."""

    def k(self, local):
        return RunningIn.k(self, replace(local, state={"slid": change(local.state["slid"])}))

    return law_of(k)


def carries(share):
    return {"share": share}


# Memory beside the state.


def counted(self, local):
    self._calls += 1
    return RunningIn.k(self, local) * (1 + 1 / self._calls)


mistake("k falls with the number of calls too", RunningIn, _calls=0, **law_of(counted))


def largest_so_far(self, local):
    self._largest = max(self._largest, float(local.pressure.max()))
    return RunningIn.k(self, local) * local.pressure.max() / self._largest


mistake(
    "k goes by the largest pressure of any call", RunningIn, _largest=0.0, **law_of(largest_so_far)
)


def by_clock(self, local):
    self._born = self._born or time.monotonic()
    return RunningIn.k(self, local) * (1 + 1e-3 * (time.monotonic() - self._born))


mistake("k ages by the clock of the machine", RunningIn, _born=None, **law_of(by_clock))


def in_a_buffer(self, local):
    good = RunningIn.rate(self, local)
    if self._out is None or self._out.shape != local.pressure.shape:
        self._out = np.empty_like(local.pressure)
    self._out[:] = good.depth_rate
    return replace(good, depth_rate=self._out)


mistake(
    "The depth lies in a buffer that the next call overwrites",
    RunningIn,
    _out=None,
    rate=in_a_buffer,
)
mistake(
    "Debris carries more with the distance slid, beside its state",
    Debris,
    **carries(
        lambda self, c: -np.expm1(-c.state["debris"] / self.cover * (1 + c.distance / self.length))
    ),
)
mistake(
    "A film fades by the distance since the start of the run",
    Tribofilm,
    faded=lambda self, c: c.state["film"] / self.life * np.exp(-c.distance / self.length),
)
mistake(
    "A film forms less with the distance, beside its state",
    Tribofilm,
    formed=lambda self, c: Tribofilm.formed(self, c) / (1 + c.distance / self.length),
)


def since_the_last_call(self, contact):
    step = max(contact.time - self._last, 0.0) or self.life
    self._last = contact.time
    return -contact.state["film"] * np.expm1(-step / self.life) / step


mistake(
    "A film fades over the time since the last call",
    Tribofilm,
    _last=0.0,
    faded=since_the_last_call,
)


def calls_of_the_effect(self, contact):
    self._calls += 1
    return -np.expm1(-contact.state["debris"] / self.cover) * (1 - 0.5**self._calls)


mistake("Debris carries more from call to call", Debris, _calls=0, share=calls_of_the_effect)


def kept_share(self, contact):
    now = Debris.share(self, contact)
    same = self._share is not None and self._share.shape == now.shape
    self._share = 0.7 * now + 0.3 * self._share if same else now
    return self._share


mistake("The share is damped from call to call", Debris, _share=None, share=kept_share)


def film_in_a_buffer(self, contact):
    if self._out is None or self._out.shape != contact.pressure.shape:
        self._out = np.empty_like(contact.pressure)
    self._out[:] = Tribofilm.friction(self, contact)
    return self._out


mistake(
    "Friction lies in a buffer that the next call overwrites",
    Tribofilm,
    _out=None,
    friction=film_in_a_buffer,
)

# States that lie elsewhere.

mistake("The state is read transposed in a square window", RunningIn, **by_state(square))
mistake(
    "The state is read from the other end of x", RunningIn, **by_state(lambda s: s[..., ::-1, :])
)
mistake("The state is read from the other side of y", RunningIn, **by_state(lambda s: s[..., ::-1]))
mistake("The state is read a cell behind", RunningIn, **by_state(lambda s: np.roll(s, 1, axis=-2)))
mistake(
    "The state is sorted along y",
    RunningIn,
    **by_state(lambda s: np.sort(s, axis=-1)),
)
mistake(
    "The state of the first position holds at all",
    RunningIn,
    **by_state(lambda s: s[:1] + 0 * s),
)
mistake(
    "The state is that of the middle row",
    RunningIn,
    **by_state(lambda s: s[..., s.shape[-2] // 2, :][..., None, :] + 0 * s),
)
mistake(
    "The slid distance is given transposed in a square window",
    RunningIn,
    slid=lambda self, local: square(RunningIn.slid(self, local)),
)
mistake(
    "Debris carries where it lies transposed, in a square window",
    Debris,
    **carries(lambda self, c: -np.expm1(-square(c.state["debris"]) / self.cover)),
)
mistake(
    "Debris carries on the other side of y",
    Debris,
    **carries(lambda self, c: -np.expm1(-c.state["debris"][:, ::-1] / self.cover)),
)
mistake(
    "Debris leaves where it lies mirrored along x",
    Debris,
    leaving=lambda self, c: np.where(c.pressure > 0, c.state["debris"][::-1] / self.length, 0.0),
)
mistake(
    "A film forms transposed in a square window",
    Tribofilm,
    formed=lambda self, c: square(Tribofilm.formed(self, c)),
)
mistake(
    "A film fades by its mean along y",
    Tribofilm,
    faded=lambda self, c: (
        np.mean(c.state["film"], axis=1, keepdims=True) / self.life + 0 * c.pressure
    ),
)

# Growth without an end, and states beyond their limits.

mistake(
    "k grows in proportion to the distance, without end",
    RunningIn,
    **law_of(lambda self, local: self.k_last * (1 + local.state["slid"] / (500 * self.length))),
)
mistake(
    "k grows by e over a kilometre",
    RunningIn,
    **law_of(
        lambda self, local: (
            RunningIn.k(self, local) * np.exp(local.state["slid"] / 500 / self.length)
        )
    ),
)
mistake(
    "k falls in proportion, below 0 after a kilometre",
    RunningIn,
    **law_of(lambda self, local: self.k_first * (1 - local.state["slid"] / (500 * self.length))),
)
mistake(
    "Worn depth wears the faster, without end",
    Coating,
    rate=lambda self, local: (
        lambda k: WearRate(k * local.pressure, k, {"worn_depth": k * local.pressure})
    )(
        np.where(local.state["worn_depth"] < self.thickness, self.k, self.below)
        * (1 + local.state["worn_depth"] / self.thickness)
    ),
)
mistake(
    "Debris makes debris, by a thousandth of its length",
    Debris,
    state_rates=lambda self, c: {
        "debris": c.speed * (self.source(c) + 1e-3 * c.state["debris"] / self.length)
    },
)
mistake(
    "Debris goes on leaving when none is left",
    Debris,
    leaving=lambda self, c: np.where(c.pressure > 0, self.cover / self.length, 0.0),
)
mistake("Oxide begins at more than all", Oxide, initial_state=lambda self: {"cover": 1.5})
mistake(
    "A film is rubbed off at one rate, though none is left",
    Lubricated,
    rubbed=lambda self, local: np.where(local.pressure > 0, -1 / self.length, 0.0),
)
mistake(
    "Oxide grows out of contact",
    Oxide,
    rate=lambda self, local: replace(
        Oxide.rate(self, local), state_rates={"cover": self.grown(local)}
    ),
)
mistake(
    "Spreading debris piles up by its square",
    Spreading,
    leaving=lambda self, c: -1e-4 * c.speed * c.state["spread"] ** 2 / (self.cover * c.track),
)

# Breaks.

mistake(
    "At the break itself the rate is that below it",
    Incubation,
    factor=lambda self, local: np.where(
        local.state["cracked"] <= self.length, self.k_early, self.k
    ),
)
mistake(
    "Incubation ends at half the length, which no break tells",
    Incubation,
    factor=lambda self, local: np.where(
        local.state["cracked"] < 0.5 * self.length, self.k_early, self.k
    ),
)
mistake(
    "A coating is worn through at its thickness of all points' mean",
    Coating,
    rate=lambda self, local: (
        lambda k: WearRate(
            k * local.pressure, k + 0 * local.pressure, {"worn_depth": k * local.pressure}
        )
    )(self.k if local.state["worn_depth"].mean() < self.thickness else self.below),
)
mistake(
    "The worn depth is said to grow by half of what wears",
    Coating,
    state_fields=property(lambda self: (replace(WORN_DEPTH, breaks=(self.thickness,)),)),
    rate=lambda self, local: replace(
        Coating.rate(self, local),
        state_rates={"worn_depth": 0.5 * Coating.rate(self, local).depth_rate},
    ),
)
