"""A run gone through backwards: how an objective follows each of its parts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from tribo.contact.projection import over
from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.core.fields import FRICTION_COEFFICIENT, PLACE_X, PLACE_Y
from tribo.simulation.model import Model
from tribo.stepping.implicit import Implicit
from tribo.study.gradient.linear import StepSystem
from tribo.study.gradient.objective import Seeds
from tribo.study.gradient.parameters import Chain
from tribo.study.gradient.tape import Enveloped, Gave, Pressed, Saved, Tape
from tribo.study.gradient.touched import Touched, carriers

NUDGE = 3e-5
"""Part of the pressure by which it is varied to find the derivative of a law, up and down."""
AT_ONCE = 1 << 18
"""Cells for which a law with another number is asked at once."""
KNOWN = {FRICTION_COEFFICIENT.name, PLACE_X.name, PLACE_Y.name}


def check_covered(model: Model) -> None:
    """Refuse a case with what has no gradient here; `CaseError` names it."""
    if not isinstance(model.stepping, Implicit):
        raise CaseError("gradients go through implicit steps only", "stepping.type")
    if model.case.stop.depth is not None:
        raise CaseError(
            "a run that a depth ends has another length for each input; give stop.distance or the "
            "motion's own end",
            "stop.depth",
        )
    if model.case.effects:
        raise CaseError(
            "gradients do not go through effects; leave out those that no law follows, and no load",
            "effects",
        )
    for name, law in model.laws.items():
        place = f"bodies.{name}.wear"
        if getattr(model.bodies[name], "layers", ()):
            raise CaseError("gradients do not go through layers", f"bodies.{name}.layers")
        if law.state_fields:
            raise CaseError(
                f"{law.component.type!r} remembers ({law.state_fields[0].name}); gradients go "
                "through laws without a state",
                place,
            )
        if beyond := set(law.requires) - KNOWN:
            raise CaseError(
                f"{law.component.type!r} follows {', '.join(sorted(beyond))}, whose derivative in "
                "pressure is not known",
                place,
            )
    if model.contact.operator(model.system, model.gap <= np.min(model.gap)) is None:
        raise CaseError(f"{model.contact.type!r} does not state its operator", "contact.type")


@dataclass(frozen=True)
class Sensitivities:
    """Derivatives of an objective.

    Parameters
    ----------
    parameters : sequence of float
        In each parameter.
    wear_rate : Mapping[str, ndarray]
        In a factor on each body's wear rate, at each cell of its own surface.
    height : Mapping[str, ndarray]
        In each body's height outward, on its own surface.
    worn_before : Mapping[str, ndarray]
        In the depth worn off each body at the beginning, on its own surface.
    """

    parameters: Sequence[float]
    wear_rate: Mapping[str, Array]
    height: Mapping[str, Array]
    worn_before: Mapping[str, Array]


def swept_back(
    model: Model, tape: Tape, seeds: Mapping[float, Seeds], chains: Sequence[Chain]
) -> Sensitivities:
    """Go through a run backwards; return the derivatives of the objective with these seeds.

    Each step gave w¹ = w⁰ + Δs Σₘ ωₘ Jₘ r(pₘ), with K pₘ + h + Tₘ w¹ = δₘ on its free cells. With
    λ¹ the derivative of the objective in w¹, and r' that of the step's depth in pressure, the
    adjoint is one more solve on these cells::

        K zₘ + r' Jₘᵀ Σₙ Tₙᵀ ωₙ zₙ + μₘ = r' Jₘᵀ λ¹,  Σ zₘ = 0,  λ⁰ = λ¹ − Σₙ Tₙᵀ ωₙ zₙ

    Cells at the hardness have a fixed z, by what their overlap adds to the plastic depth.
    """
    back = _Back(model, chains)
    for record in reversed(tape):
        if isinstance(record, Saved):
            back.look(seeds[record.time])
        elif isinstance(record, Gave):
            back.gave = record.places
        elif isinstance(record, Enveloped):
            back.spread_out(record)
        else:
            back.press(record)
    return back.outcome()


class _Back:
    """What has been gathered so far, from the end of a run back."""

    def __init__(self, model: Model, chains: Sequence[Chain]) -> None:
        self.model = model
        self.chains = chains
        cells, positions = model.grid.cells, len(model.cycle)
        self.shares = np.array([position.share for position in model.cycle])
        self.carriers = carriers(model)
        own = {name: (carrier.rows, cells[1]) for name, carrier in self.carriers.items()}
        self.wear = {name: np.zeros(shape) for name, shape in own.items()}
        self.height = {name: np.zeros(shape) for name, shape in own.items()}
        self.factor = {name: np.zeros(own[name]) for name in model.laws}
        self.plastic = {
            name: np.zeros(cells if self.carriers[name].weights is not None else own[name])
            for name, share in model.plastic_share.items()
            if model.system.cap is not None
        }
        self.gap = np.zeros((positions, *cells))
        self.pressure: Array | None = None
        self.gave: Sequence[int] = ()
        self.stiffness = self.cap = 0.0
        self.sums = np.zeros(len(chains))
        self.start = np.zeros((positions, *cells))
        self.waiting: dict[float, list[tuple[Touched, dict[str, Array]]]] = {}
        self.count = 0

    def look(self, seeds: Seeds) -> None:
        """Add the derivatives of the objective in a saved state."""
        for name, seed in seeds.wear.items():
            self.wear[name] = self.wear[name] + seed
        if seeds.pressure is not None:
            if self.pressure is None:
                self.pressure = np.zeros_like(self.gap)
            self.pressure[len(self.gap) // 2] += seeds.pressure

    def spread_out(self, record: Enveloped) -> None:
        """Go back through an envelope: all of a row follows its deepest cell."""
        for name, rows in record.rows.items():
            if name in self.plastic:
                total = np.sum(self.plastic[name], axis=0)
                self.plastic[name] = np.zeros_like(self.plastic[name])
                self.plastic[name][rows, np.arange(len(rows))] = total

    def press(self, record: Pressed) -> None:
        """Go back through a contact, and what was worn under it."""
        pressed, yielded = self.pressure, self.gave
        self.pressure, self.gave = None, ()
        if record.slid is None and pressed is None and not yielded:
            return
        model, window = self.model, np.zeros_like(self.gap)
        window[(slice(None), *record.region)] = record.pressure
        found = model.contact.operator(model.system, np.any(window > 0, axis=0))
        assert found is not None
        box, operator = found
        here = (slice(None), *box.slices)
        pressure = window[here]
        full = np.zeros_like(pressure, dtype=bool)
        if model.system.cap is not None:
            full = pressure >= model.system.cap * (1 - 1e-12)
        free = (pressure > 0) & ~full

        cells = _touched(window)
        rates: dict[str, Array] = {}
        slopes: dict[str, Array] = {}
        increment = 0.0
        if record.slid is not None:
            increment = record.slid.end_distance - record.slid.distance
            speed = increment / (record.slid.end_time - record.slid.time)
            rates, slopes = self._rates(cells, speed)
        given, bodies = np.zeros_like(pressure), []
        for name, slope in slopes.items():
            steep = np.zeros_like(window)
            steep[window > 0] = increment * slope
            bodies.append((self.carriers[name], steep[here]))
            given += steep[here] * self.carriers[name].seen(self.wear[name], box)
        weights = np.where(self.shares > 0, self.shares, 1.0)
        if pressed is not None:
            given += pressed[here] / over(weights)
        fixed = np.zeros_like(pressure)
        if yielded and record.overlap is not None:
            fixed = self._gave(record, yielded)[here] * full / over(weights)
        system = StepSystem(operator, box, self.shares, bodies, free)
        z, mean, left = system.solve(given, fixed, self.start[here])
        self.start = np.zeros_like(self.start)
        self.start[here] = z
        y = over(self.shares) * z

        for name, carrier in self.carriers.items():
            taken = carrier.gathered(y, box)
            self.wear[name] = self.wear[name] - taken
            self.height[name] = self.height[name] + taken
            if name in self.plastic:
                if carrier.weights is None:
                    self.plastic[name] = self.plastic[name] - taken
                else:
                    self.plastic[name] = self.plastic[name].copy()
                    self.plastic[name][box.slices] -= np.sum(y, axis=0)
        self.gap[here] -= y
        self.stiffness += float(np.sum(y * operator.apply(pressure)))
        self.cap += float(np.sum(over(self.shares) * (left - over(mean)) * full))
        by_load = self.shares * mean / model.grid.cell_area
        for at, chain in enumerate(self.chains):
            self.sums[at] += chain.by_load(record, by_load)
            if record.slid is not None and chain.moves:
                self.sums[at] += chain.by_motion(record.slid, cells, self.wear)
        by_rate = {}
        for name, rate in rates.items():
            carrier = self.carriers[name]
            seen = cells.seen(carrier, self.wear[name])
            by_rate[name] = increment * self.shares[cells.position] * seen
            self.factor[name] += cells.summed(carrier, by_rate[name] * rate)
        if record.slid is not None:
            self.waiting.setdefault(float(f"{speed:.9g}"), []).append((cells, by_rate))
            self.count += len(cells.pressure)
            if self.count > AT_ONCE:
                self.ask_laws()

    def ask_laws(self) -> None:
        """Ask laws with other numbers for all the cells that wait for it, speed by speed."""
        for speed, parts in self.waiting.items():
            cells = Touched.joined([part for part, _ in parts])
            by_rate = {
                name: np.concatenate([of[name] for _, of in parts]) for name in self.model.laws
            }
            for at, chain in enumerate(self.chains):
                if not chain.moves:
                    self.sums[at] += chain.by_law(cells, speed, by_rate)
        self.waiting, self.count = {}, 0

    def _rates(self, cells: Touched, speed: float) -> tuple[dict[str, Array], dict[str, Array]]:
        """Return the rate of each body in the cells, and its derivative in pressure."""
        rates, slopes = {}, {}
        for name in self.model.laws:
            rates[name], higher, lower = (
                cells.rate(self.model, name, self.carriers[name], speed, by * cells.pressure)
                for by in (1.0, 1 + NUDGE, 1 - NUDGE)
            )
            slopes[name] = (higher - lower) / (2 * NUDGE * cells.pressure)
        return rates, slopes

    def _gave(self, record: Pressed, places: Sequence[int]) -> Array:
        """Return the derivative in the overlap at each position, shape (positions, nx, ny)."""
        model, overlap = self.model, np.zeros_like(self.gap)
        assert record.overlap is not None
        overlap[(slice(None), *record.region)] = record.overlap
        found = np.zeros_like(overlap)
        for name, share in model.plastic_share.items():
            if share == 0:
                continue
            laid = np.stack([model.spread(name, overlap[m], m) for m in places])
            first = np.argmax(laid, axis=0)
            for at, m in enumerate(places):
                deeper = np.where(first == at, self.plastic[name], 0.0)
                found[m] += share * model.under(name, deeper, m)
        return found

    def outcome(self) -> Sensitivities:
        """Return all derivatives."""
        self.ask_laws()
        sums = [
            float(total) + chain.by_rest(self.gap, self.stiffness, self.cap)
            for total, chain in zip(self.sums, self.chains, strict=True)
        ]
        return Sensitivities(sums, self.factor, self.height, self.wear)


def _touched(window: Array) -> Touched:
    position, x, y = np.nonzero(window)
    return Touched(position, x, y, window[position, x, y])
