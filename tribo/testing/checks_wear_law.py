"""What every wear law must fulfil."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from tribo.core.arrays import Array
from tribo.core.fields import LocalConditions, WearRate
from tribo.testing import samples
from tribo.testing.checks_calls import Exercise, call_checks, locked
from tribo.testing.compare import expect_array, expect_close
from tribo.testing.declared import expect_declared
from tribo.testing.subject import Subject, fact, require

_SHAPE = (7, 6)
# Not an order of magnitude apart, so that a pressure between two is like both.
_LADDER = np.geomspace(1e5, samples.PEAK, 160)

_FOLLOWING = (
    "; if a field that it requires follows the pressure, say how: see 'Fields that follow the "
    "pressure' in docs/plugins.md"
)


def _inputs(subject: Subject, law: Any, number: int) -> LocalConditions:
    pressure = samples.sample_pressure(_SHAPE) if number == 0 else np.full(_SHAPE, 1e8)
    return samples.local_conditions(subject, law, pressure)


def _call(law: Any, local: LocalConditions) -> Mapping[str, Any]:
    rate = law.rate(local)
    return {
        "depth": rate.depth_rate,
        "derivative": rate.depth_slope,
        "state": dict(rate.state_rates),
    }


EXERCISE = Exercise(_inputs, _call)


def _stateless(subject: Subject) -> str | None:
    return None if subject.make().state_fields else "it declares no state_fields"


def _slid(subject: Subject, law: Any) -> LocalConditions:
    """Return conditions in which every point has its own state: after sliding 1 m."""
    local = _inputs(subject, law, 0)
    rate = law.rate(local)
    state = {name: local.state[name] + np.asarray(rate.state_rates[name]) for name in local.state}
    return locked(replace(local, state=state))  # type: ignore[no-any-return]


@fact
def rates_are_finite_arrays(subject: Subject) -> None:
    """Depth and derivative are finite float64 arrays of the pressure's shape."""
    law = subject.make()
    for number in (0, 1):
        rate = law.rate(locked(_inputs(subject, law, number)))
        require(isinstance(rate, WearRate), f"rate gave {type(rate).__name__}, not a WearRate")
        expect_array("depth", rate.depth_rate, _SHAPE)
        expect_array("derivative", rate.depth_slope, _SHAPE)


@fact
def nothing_wears_without_pressure(subject: Subject) -> None:
    """Where the pressure is 0 the depth is 0."""
    law = subject.make()
    local = _slid(subject, law)
    idle = law.rate(local).depth_rate[local.pressure == 0]
    require(not idle.any(), f"the depth per metre is up to {np.max(np.abs(idle)):.3g} where p = 0")


@fact
def wear_only_removes(subject: Subject) -> None:
    """The depth per metre is never negative."""
    law = subject.make()
    least = min(
        _ladder(subject, law).depth_rate.min(), law.rate(_slid(subject, law)).depth_rate.min()
    )
    require(least >= 0, f"the depth per metre falls to {least:.3g}; it must be at least 0")


@fact
def derivative_is_that_of_the_depth(subject: Subject) -> None:
    """The derivative agrees with the differences of the depth in pressure."""
    law = subject.make()
    step = 1e-5 * _LADDER
    rate, up, down = (_ladder(subject, law, _LADDER + s) for s in (0 * step, step, -step))
    forward, backward = (
        (up.depth_rate - rate.depth_rate) / step,
        (rate.depth_rate - down.depth_rate) / step,
    )
    found = np.asarray(rate.depth_slope)
    # At a kink one side is right. Round-off of the depth is 1e-11 of depth/p.
    allowed = 1e-4 * np.maximum(np.abs(found), rate.depth_rate / _LADDER)
    error = np.min([np.abs(found - s) for s in (forward, backward, (forward + backward) / 2)], 0)
    at = int(np.argmax(error - allowed))
    slope = (forward[at] + backward[at]) / 2
    require(
        error[at] <= allowed[at],
        f"at p = {_LADDER[at]:.3g} Pa the derivative is {found[at]:.6g} 1/Pa, but the depth "
        f"changes by {slope:.6g} per Pa{_FOLLOWING if law.requires else ''}",
    )


def _falls(subject: Subject) -> str | None:
    falls = np.any(_ladder(subject, subject.make()).depth_slope < 0)
    return "its derivative is negative somewhere" if falls else None


@fact(unless=_falls)
def depth_grows_with_pressure(subject: Subject) -> None:
    """Where the derivative is not negative, more pressure never wears less."""
    depth = _ladder(subject, subject.make()).depth_rate
    at = int(np.argmin(np.diff(depth)))
    require(
        depth[at + 1] >= depth[at] * (1 - 1e-12),
        f"the depth per metre falls from {depth[at]:.6g} to {depth[at + 1]:.6g} as the pressure "
        f"rises from {_LADDER[at]:.3g} to {_LADDER[at + 1]:.3g} Pa",
    )


@fact
def points_are_independent(subject: Subject) -> None:
    """A point wears the same wherever it lies and whatever the other points do."""
    law = subject.make()
    local = _slid(subject, law)
    whole = law.rate(local)
    order = np.argsort(samples.pattern((local.pressure.size,)))
    for what, chosen in (
        ("with the points in another order", order),
        ("with half of the points left out", order[: order.size // 2]),
    ):
        part = law.rate(_chosen(local, chosen))
        for name, found, needed in _pairs(part, whole):
            expect_close(f"{name} {what}", found, needed.reshape(-1)[chosen], 1e-12)


@fact
def only_declared_fields_are_asked_for(subject: Subject) -> None:
    """It asks for no local field but those in `requires`, and no state but its `state_fields`."""
    law = subject.make()
    local = _inputs(subject, law, 0)
    fields, state = samples.Asked(local.fields), samples.Asked(local.state)
    error: Exception | None = None
    try:
        law.rate(locked(replace(local, fields=fields, state=state)))
    except Exception as raised:
        error = raised
    for asked, declared in ((fields, "requires"), (state, "state_fields")):
        missed = ", ".join(sorted(asked.missed))
        require(not missed, f"it asked for {missed}; add that to {declared}")
    if error is not None:
        raise error


@fact(unless=_stateless)
def every_state_field_has_a_rate(subject: Subject) -> None:
    """Each declared state field has an initial value and a finite rate, and no other has."""
    law = subject.make()
    declared = {field.name for field in law.state_fields}
    rate = law.rate(locked(_inputs(subject, law, 0)))
    for what, given in (("initial_state", law.initial_state()), ("rate", rate.state_rates)):
        require(
            set(given) == declared,
            f"{what} has {sorted(given)}; state_fields declares {sorted(declared)}",
        )
    for name, values in rate.state_rates.items():
        expect_array(f"the rate of {name!r}", values, _SHAPE)


@fact(unless=_stateless)
def state_fields_are_declared(subject: Subject) -> None:
    """Each state field has a name, an SI unit and a description."""
    expect_declared("state_fields", subject.make().state_fields)


@fact
def runs_under_implicit_stepping(subject: Subject) -> None:
    """Under implicit steps and stroke averaging each body loses just what the law says."""
    law = subject.make()
    peak = law.rate(_at(subject, law, np.array([[samples.PEAK]])))
    approach = 2.2e-6  # of the small case, in m
    depth = float(peak.depth_rate[0, 0])
    distance = 0.3 * approach / depth if depth > 0 else 1.0
    samples.expect_volume_balance(
        samples.small_model(
            subject, law=law, kinematics=samples.sliding(float(np.clip(distance, 1e-3, 1e6)))
        )
    )


CHECKS = (
    *call_checks(EXERCISE),
    rates_are_finite_arrays,
    nothing_wears_without_pressure,
    wear_only_removes,
    derivative_is_that_of_the_depth,
    depth_grows_with_pressure,
    points_are_independent,
    only_declared_fields_are_asked_for,
    every_state_field_has_a_rate,
    state_fields_are_declared,
    runs_under_implicit_stepping,
)


def _at(subject: Subject, law: Any, pressure: Array) -> LocalConditions:
    """Return conditions with typical fields, the same at every point."""
    fields = {name: samples.typical(name, subject.fields, pressure) for name in law.requires}
    local = replace(samples.local_conditions(subject, law, pressure), fields=fields)
    return locked(local)  # type: ignore[no-any-return]


def _ladder(subject: Subject, law: Any, pressure: Array = _LADDER) -> WearRate:
    rate: WearRate = law.rate(_at(subject, law, pressure[:, None].copy()))
    shape = (pressure.size, 1)
    depth, derivative = (
        np.broadcast_to(v, shape)[:, 0] for v in (rate.depth_rate, rate.depth_slope)
    )
    return WearRate(depth, derivative)


def _chosen(local: LocalConditions, order: Any) -> LocalConditions:
    def choose(values: Array) -> Array:
        chosen: Array = values.reshape(-1)[order].reshape(-1, 1)
        return chosen

    chosen = replace(
        local,
        pressure=choose(local.pressure),
        fields={name: choose(values) for name, values in local.fields.items()},
        state={name: choose(values) for name, values in local.state.items()},
    )
    return locked(chosen)  # type: ignore[no-any-return]


def _pairs(part: WearRate, whole: WearRate) -> list[tuple[str, Array, Array]]:
    pairs = [
        ("depth", part.depth_rate, whole.depth_rate),
        ("derivative", part.depth_slope, whole.depth_slope),
    ]
    pairs += [
        (f"the rate of {n!r}", part.state_rates[n], whole.state_rates[n]) for n in whole.state_rates
    ]
    return [
        (name, np.asarray(found).reshape(-1), np.broadcast_to(needed, _SHAPE))
        for name, found, needed in pairs
    ]
