"""From a solved contact to the wear rate of each body."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from tribo.contact.box import around, whole
from tribo.core.arrays import Array, readonly
from tribo.core.errors import NumericalError
from tribo.core.fields import FRICTION_COEFFICIENT, ContactConditions, LocalConditions, WearRate
from tribo.core.state import State
from tribo.simulation.model import Body, Model


@dataclass(frozen=True)
class Moment:
    """When rates are asked for: end of the step (s, m) and its mean speed (m/s)."""

    time: float
    distance: float
    speed: float


# Cells around the contact where laws are asked too: what a step may newly touch.
MARGIN = 8

LawStates = Mapping[str, Mapping[str, Array]]


def law_states(state: State) -> LawStates:
    """Return the state fields of each body's law."""
    return {name: body.law for name, body in state.bodies.items()}


def wear_rates(
    model: Model, pressure: Array, law_states: LawStates, moment: Moment
) -> dict[str, WearRate]:
    """Return the rate of every body that wears, in the contact frame.

    Parameters
    ----------
    model : Model
        The composed case.
    pressure : ndarray, shape (nx, ny)
        In Pa.
    law_states : Mapping[str, Mapping[str, ndarray]]
        State fields of each body's law, on the body's surface.
    moment : Moment
        When.

    Raises
    ------
    NumericalError
        If an effect or a law answers with anything but finite arrays of the
        right shape, or a negative depth.
    """
    pressure = readonly(pressure)
    fields = _effect_fields(model, pressure, moment)
    everywhere = whole(model.grid.cells)
    near = around(pressure > 0, MARGIN)
    rates = {}
    for body in model.bodies:
        if body.wear is None:
            continue
        # A law is pointwise, so it need not be asked where nothing touches; its state
        # fields, though, may change there.
        box = everywhere if body.wear.state_fields else near
        local = LocalConditions(
            pressure=pressure[box.slices],
            speed=moment.speed,
            material=body.material,
            fields={name: fields[name][body.name][box.slices] for name in body.wear.requires},
            state={
                name: readonly(np.broadcast_to(values, pressure.shape)[box.slices])
                for name, values in law_states[body.name].items()
            },
        )
        rate = _checked(body, body.wear.rate(local), box.shape, moment)
        if not box.is_window:
            rate = WearRate(box.embed(rate.depth), box.embed(rate.derivative))
        rates[body.name] = rate
    return rates


def _effect_fields(model: Model, pressure: Array, moment: Moment) -> dict[str, dict[str, Array]]:
    shape = pressure.shape
    fields: dict[str, dict[str, Array]] = {}
    if model.friction_coefficient is not None:
        uniform = readonly(np.full(shape, model.friction_coefficient))
        fields[FRICTION_COEFFICIENT.name] = {body.name: uniform for body in model.bodies}
    for effect in model.effects:
        answer = effect.fields(
            ContactConditions(
                grid=model.grid,
                pressure=pressure,
                speed=moment.speed,
                time=moment.time,
                distance=moment.distance,
                friction_coefficient=model.friction_coefficient,
                materials={body.name: body.material for body in model.bodies},
                swept=frozenset(b.name for b in model.bodies if model.is_swept(b.name)),
                fields=fields,
            )
        )
        if not isinstance(answer, Mapping):
            kind = type(answer).__name__
            raise NumericalError(f"effect {effect.type_name()!r} gave a {kind}, not its fields")
        for field in effect.provides:
            fields[field.name] = {}
            for body in model.bodies:
                of_bodies = answer.get(field.name, {})
                values = of_bodies.get(body.name) if isinstance(of_bodies, Mapping) else None
                who = f"effect {effect.type_name()!r}"
                what = f"{field.name!r} for body {body.name!r}"
                if values is None:
                    raise NumericalError(f"{who} gave no {what}")
                array, _ = _finite(who, what, values, shape, moment)
                fields[field.name][body.name] = readonly(array)
    return fields


def _checked(body: Body, rate: WearRate, shape: tuple[int, int], moment: Moment) -> WearRate:
    assert body.wear is not None
    who = f"wear law {body.wear.type_name()!r} of body {body.name!r}"
    if not isinstance(rate, WearRate):
        raise NumericalError(f"{who} gave a {type(rate).__name__} instead of a WearRate")
    depth, least = _finite(who, "a depth per metre", rate.depth, shape, moment)
    slope, flattest = _finite(who, "a derivative", rate.derivative, shape, moment)
    if least < 0:
        raise NumericalError(
            f"{who} gave a negative depth per metre ({least:.3g}) at "
            f"{moment.distance:.6g} m; wear only removes"
        )
    if not isinstance(rate.state, Mapping):
        raise NumericalError(f"{who} gave a {type(rate.state).__name__} as rates of its state")
    state = {}
    for field in body.wear.state_fields:
        if field.name not in rate.state:
            raise NumericalError(f"{who} gave no rate for its state field {field.name!r}")
        what = f"a rate of {field.name!r}"
        state[field.name], _ = _finite(who, what, rate.state[field.name], shape, moment)
    return WearRate(depth, np.maximum(slope, 0.0) if flattest < 0 else slope, state)


def _finite(
    who: str, what: str, values: object, shape: tuple[int, ...], moment: Moment
) -> tuple[Array, float]:
    """Return `values` as an array of finite floats, and the smallest of them."""
    if isinstance(values, np.ndarray) and values.shape == shape and values.dtype == np.float64:
        array = values
    else:
        try:
            plain = np.asarray(values)
            if plain.dtype.kind not in "fiub":
                raise TypeError(f"its values are of the kind {plain.dtype}")
            array = np.broadcast_to(plain.astype(np.float64), shape)
        except (TypeError, ValueError) as error:
            raise NumericalError(
                f"{who} gave {what} that is not an array of shape {shape}: {error}"
            ) from error
    low, high = float(array.min()), float(array.max())
    # Both are NaN if any value is.
    if not -np.inf < low <= high < np.inf:
        raise NumericalError(
            f"{who} gave {what} that is not finite in {np.count_nonzero(~np.isfinite(array))} "
            f"cells, at {moment.distance:.6g} m ({moment.time:.6g} s)"
        )
    return array, low
