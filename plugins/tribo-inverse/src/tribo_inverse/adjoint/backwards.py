"""The adjoint of a run, from its last step back to its first."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray
from tribo import Array, Box
from tribo.kernel_api import (
    CELLS,
    Model,
    over,
    whole,
)

from tribo_inverse.adjoint.linear import StepSystem
from tribo_inverse.adjoint.parameters import Chain, Variant
from tribo_inverse.adjoint.view import Seeds
from tribo_inverse.increment.across import held
from tribo_inverse.increment.carriers import carriers_between, carriers_of
from tribo_inverse.increment.increment import Before, Increment, States, increment
from tribo_inverse.recording.local import watched
from tribo_inverse.recording.tape import Pressed, Tape

JUST = 1e-9
"""Part of the largest pressure, or of the hardness, within which a cell just touches or yields."""


@dataclass(frozen=True)
class Derivatives:
    """The derivatives of an objective: in each parameter, and by kind and body on its surface.

    The kinds are a factor on its `wear_rate`, its `height` outward and the depth `worn_before`.
    """

    parameters: Array
    maps: Mapping[str, Mapping[str, Array]]

    def plus(self, by: float, other: Derivatives) -> Derivatives:
        """Return the derivatives of this objective plus `by` times another."""
        maps = {
            kind: {name: each + by * other.maps[kind][name] for name, each in of_bodies.items()}
            for kind, of_bodies in self.maps.items()
        }
        return Derivatives(self.parameters + by * other.parameters, maps)


def swept_back(
    model: Model, tape: Tape, seeds: Mapping[float, Seeds], chains: Sequence[Chain]
) -> Derivatives:
    """Return the derivatives of an objective with these seeds, by the adjoint of a run.

    Each step gave w¹ = w⁰ + Δs Σₘ ωₘ Jₘ r(pₘ), with K pₘ + h + Tₘ w¹ = δₘ on its free cells. With
    λ¹ the derivative of the objective in w¹, and ωₘ r' the derivative of the step's depth in
    pressure, the adjoint is one more solve on these cells::

        K zₘ + r' Tₘ Σₙ Tₙᵀ ωₙ zₙ + μₘ = r' Tₘ λ¹,  Σ zₘ = 0,  λ⁰ = λ¹ − Σₙ Tₙᵀ ωₙ zₙ

    An explicit step has r' at the contacts before it, which are solved by themselves. Cells at the
    hardness have a fixed z, the derivative in their overlap. The states of laws add to the right
    side, and their adjoint is carried back through the step.
    """
    cells = model.grid.cells
    touched = Box.of(tape.touched, cells) if tape.touched else whole(cells)
    back = Backwards(model, chains, touched, seeds)
    for name, given in reversed(tape):
        getattr(back, name)(given)
    back.rest()
    kinds = ("wear_rate", "height", "worn_before")
    return Derivatives(back.parameters, {kind: vars(back)[kind] for kind in kinds})


class Backwards:
    """The derivatives of an objective, accumulated from the end of a run back.

    By body at each cell of its surface: in a factor on its `wear_rate`, in its `height` outward and
    in the depth `worn_before`.
    """

    def __init__(
        self,
        model: Model,
        chains: Sequence[Chain],
        touched: Box,
        seeds: Mapping[float, Seeds],
    ) -> None:
        self.seeds, self.seen = seeds, set[str]()
        self.model = model = held(watched(model, self.seen))
        self.chains, self.touched = chains, touched
        cells, positions = model.grid.cells, len(model.cycle)
        self.shares = np.array([position.share for position in model.cycle])
        self.carriers = carriers_of(model)
        own = {name: carrier.shape for name, carrier in self.carriers.items()}
        self.worn_before = {name: np.zeros(shape) for name, shape in own.items()}
        self.height = {name: np.zeros(shape) for name, shape in own.items()}
        self.wear_rate = {name: np.zeros(own[name]) for name in model.laws.wear}
        self.between = carriers_between(model, self.carriers)
        self.states: States = {}
        self.plastic = {
            name: np.zeros(cells if self.carriers[name].weights is not None else own[name])
            for name, share in model.contact.plastic_share.items()
            if model.contact.system.cap is not None
        }
        self.gap = np.zeros((positions, *cells))
        self.pressure = np.zeros_like(self.gap)
        self.gave: Sequence[int] = ()
        self.stiffness = self.cap = 0.0
        self.parameters = np.zeros(len(chains))
        self.start = np.zeros((positions, *cells))

    def saved(self, time: float) -> None:
        """Add the derivatives of the objective in the state saved at a time (s)."""
        seeds = self.seeds[time]
        for name, seed in seeds.wear.items():
            self.worn_before[name] = self.worn_before[name] + seed
        if seeds.pressure is not None:
            self.pressure[len(self.gap) // 2] += seeds.pressure

    def yielded(self, places: Sequence[int]) -> None:
        """Note that the overlap at some positions becomes plastic depth after a contact."""
        self.gave = places

    def drawn(self, deepest: Mapping[str, NDArray[np.intp]]) -> None:
        """Carry the adjoint through an envelope: all of a row depends on its deepest cell."""
        for name, rows in deepest.items():
            if name in self.plastic:
                total = np.sum(self.plastic[name], axis=0)
                self.plastic[name] = np.zeros_like(self.plastic[name])
                self.plastic[name][rows, np.arange(len(rows))] = total

    def pressed(self, record: Pressed) -> None:
        """Carry the adjoint through a contact and the wear under it."""
        looked, yielded, slid = self.pressure, self.gave, record.slid
        self.pressure, self.gave = np.zeros_like(self.gap), ()
        if slid is None:
            if np.any(looked) or yielded:
                self._solve(record, looked, yielded, None)
            return
        part = increment(self.model, self.carriers, self.touched, record, slid)
        before = None if slid.ahead else self._solve(record, looked, yielded, part)
        if before is None:
            before = part.back(self.worn_before, self.states)
            self.pressure = looked + over(self.shares) * before.pressure
        self._wear(part, before)

    def _solve(
        self,
        record: Pressed,
        looked: Array,
        yielded: Sequence[int],
        part: Increment | None,
    ) -> Before | None:
        """Carry the adjoint through one implicit contact solve, after its increment.

        `looked` are the derivatives of the objective in its pressures. Return the derivatives in
        the inputs of the increment.
        """
        model, window = self.model, record.in_window(record.pressure, self.model.grid.cells)
        touching = np.any(window > 0, axis=0)
        found = model.case.contact.operator(model.contact.system, touching)
        assert found is not None
        box, operator = found
        here = (slice(None), *box.slices)
        pressure = window[here]
        full = np.zeros_like(pressure, dtype=bool)
        if model.contact.system.cap is not None:
            full = pressure >= model.contact.system.cap * (1 - JUST)
        weights = over(np.where(self.shares > 0, self.shares, 1.0))
        fixed = np.zeros_like(pressure)
        if yielded and record.overlap is not None:
            fixed = self._gave(record, yielded)[here] * full / weights
        free = (pressure > JUST * np.max(pressure)) & ~full
        bodies = [(own, steep[here]) for own, steep in part.bodies] if part else []
        whole = part is None or part.is_pointwise
        wear = None if part is None or whole else partial(self._of_wear, part, box)
        system = StepSystem(operator, box, self.shares, bodies, free, wear)

        def given() -> tuple[Before | None, Array]:
            before = part.back(self.worn_before, self.states) if part else None
            by_wear = before.pressure if before else 0.0
            return before, (looked / weights + by_wear)[here]

        z = system.solve(given()[1], fixed, self.start[here])
        self.start = np.zeros_like(self.start)
        self.start[here] = z
        stiff = operator.apply(z)
        y = over(self.shares) * z
        self._shift(y, box)
        self.stiffness += float(np.sum(over(self.shares) * stiff * pressure))
        before, left = given()
        left = left - stiff
        mean = np.sum(left * free, CELLS) / np.maximum(free.sum(CELLS), 1)
        self.cap += float(np.sum(over(self.shares) * (left - over(mean)) * full))
        by_load = self.shares * mean / model.grid.cell_area
        self._follow(lambda each: each.by_load(record, by_load))
        self._follow(lambda each: -each.by_spread(touching, y, pressure))
        return before

    def _wear(self, part: Increment, before: Before) -> None:
        """Carry the adjoint through the wear of a step under given contacts."""
        self._follow(lambda each: each.by_wear(part, before, self.seen))
        for name, factor in before.factor.items():
            self.wear_rate[name] += factor
            self.worn_before[name] = before.wear[name]
        self.states = dict(before.states)

    def _of_wear(self, increment: Increment, box: Box, z: Array) -> Array:
        """Return the contribution of wear and filling to the adjoint of K."""
        wear, states = self._by_gaps(over(self.shares) * z, box)
        filled = {of: -values for of, values in states.items()}
        found: Array = increment.back(wear, filled).pressure[(slice(None), *box.slices)]
        return found

    def _by_gaps(self, y: Array, box: Box) -> tuple[Mapping[str, Array], States]:
        """Return derivatives in surfaces and in states that fill gaps, from those in gaps."""
        filling = {
            (name, key): self.between[key] if name is None else self.carriers[name]
            for name, key in self.model.laws.filling
        }
        return (
            {name: carrier.gathered(y, box) for name, carrier in self.carriers.items()},
            {of: carrier.gathered(y, box) for of, carrier in filling.items()},
        )

    def _shift(self, y: Array, box: Box) -> None:
        """Add the derivatives in the gaps of a contact solve."""
        wear, states = self._by_gaps(y, box)
        for name, taken in wear.items():
            self.worn_before[name] = self.worn_before[name] - taken
            self.height[name] = self.height[name] + taken
            if name in self.plastic and self.carriers[name].weights is None:
                self.plastic[name] = self.plastic[name] - taken
            elif name in self.plastic:
                self.plastic[name][box.slices] -= np.sum(y, axis=0)
        self.gap[:, *box.slices] -= y
        for of, values in states.items():
            self.states[of] = self.states.get(of, 0.0) + values

    def _gave(self, record: Pressed, places: Sequence[int]) -> Array:
        """Return the derivative in the overlap at each position, shape (positions, nx, ny)."""
        model = self.model
        assert record.overlap is not None
        overlap = record.in_window(record.overlap, model.grid.cells)
        found = np.zeros_like(overlap)
        for name, share in model.contact.plastic_share.items():
            if share == 0:
                continue
            laid = np.stack([model.cycle.maps[name].lay(overlap[m], m) for m in places])
            first = np.argmax(laid, axis=0)
            for at, m in enumerate(places):
                deeper = np.where(first == at, self.plastic[name], 0.0)
                found[m] += share * model.cycle.maps[name].see(deeper, m)
        return found

    def rest(self) -> None:
        """Add the parts of the derivatives in numbers that do not depend on the step."""
        states = self.states
        self._follow(lambda each: each.by_rest(self.gap, self.stiffness, self.cap, states))

    def _follow(self, change: Callable[[Variant], float]) -> None:
        """Add a part of the derivative in each number, given its change with a variant."""
        self.parameters += [each.sum(change) for each in self.chains]
