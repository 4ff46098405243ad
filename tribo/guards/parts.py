"""The parts of a case, each held to its contract at every call: bad answers are a `BadValues`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise, product

import numpy as np

from tribo.contact.solver import ContactSolver
from tribo.contract import initial, rate_of
from tribo.core.arrays import Array, readonly
from tribo.core.contact import (
    ContactProblem,
    ContactSolution,
    ContactSystem,
    CycleCompliance,
    Residuals,
    WearCompliance,
)
from tribo.core.errors import BadValues, CaseError, PluginError
from tribo.core.fields import (
    FRICTION_COEFFICIENT,
    LOCAL_SLIP,
    WORN_DEPTH,
    ContactConditions,
    Field,
    LocalConditions,
    WearRate,
    names_of,
)
from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.core.rounding import SAME
from tribo.core.state import Snapshot, key_of
from tribo.effects.effect import Effect
from tribo.guards.guard import Guard
from tribo.surfaces.surface import Surface
from tribo.wear.law import WearLaw

NUDGE = 1e-6
"""Part of the largest pressure by which it is raised to find a slope that a law leaves out: the
error is of this size, the rounding 2e-10."""


class GuardedSurface(Guard[Surface]):
    """A surface and what it answered: its height (nx, ny) in m, and its curvature in 1/m."""

    def __init__(self, surface: Surface, body: str, grid: Grid) -> None:
        super().__init__(surface, body)
        self.height = self.array("height", self.ask(surface.height, grid), grid.cells)
        self.curvature: tuple[float, float] | None = None
        curvature: object = self.ask(getattr, surface, "curvature")
        if curvature is not None:
            along, across = self.array("curvature", curvature, (2,))
            self.curvature = float(along), float(across)


class GuardedLaw(Guard[WearLaw]):
    """A wear law that suits its body's material, and the initial values of its state fields."""

    bottoms: tuple[float, ...] = ()
    """Depths at which the layers of the body end, in m."""

    def __init__(self, law: WearLaw, body: str, material: Material) -> None:
        super().__init__(law, body)
        self.material = material
        self.requires = names_of(law.requires)
        self.state_fields = tuple(law.state_fields)
        self.ask(law.check, material)
        self.initial_state = _initial_state(self, law.state_fields, self.ask(law.initial_state))
        self.follows_depth = WORN_DEPTH.name in self.initial_state

    @property
    def breaks(self) -> tuple[float, ...]:
        """The depths worn at which its rate jumps, in m."""
        depth = (field for field in self.state_fields if field.name == WORN_DEPTH.name)
        return next(depth, WORN_DEPTH).breaks

    @property
    def own_state(self) -> dict[str, float]:
        """Its states without the depth worn, with their initial values."""
        return {n: v for n, v in self.initial_state.items() if n != WORN_DEPTH.name}

    def rate(self, local: LocalConditions) -> WearRate:
        """Return the law's rate at the shape of the pressure, its slope not negative."""
        answer, depth = self._depth(local)
        shape = local.pressure.shape
        slope = answer.depth_slope
        if slope is None:
            slope = self._slope(local, depth)
        slope = self.array("depth_slope", slope, shape)
        state = _rates(self, answer.state_rates, dict.fromkeys(self.initial_state, shape))
        if WORN_DEPTH.name in state:
            state[WORN_DEPTH.name] = depth
        rule = "what is not touched neither wears nor changes"
        untouched = local.pressure == 0
        named = {"depth_rate": depth, **{rate_of(field): state[field] for field in state}}
        for name, values in named.items():
            if bare := np.count_nonzero((values != 0) & untouched):
                fault = f"not 0 in {bare} cells where the pressure is 0"
                raise self.bad(name, fault, needed=rule)
        return WearRate(depth, np.maximum(slope, 0.0) if np.min(slope) < 0 else slope, state)

    def _depth(self, local: LocalConditions) -> tuple[WearRate, Array]:
        given = self.ask(self.component.rate, local)
        answer: WearRate = self.typed(given, WearRate, "its rate")
        depth = self.array("depth_rate", answer.depth_rate, local.pressure.shape)
        return answer, depth

    def _slope(self, local: LocalConditions, depth: Array) -> Array:
        """Return the derivative of the depth in pressure, by a finite step up; 0 at no pressure."""
        step = NUDGE * float(np.max(local.pressure))
        if step == 0:
            # As under a film that carries all: there is no pressure to take a part of.
            return np.zeros_like(local.pressure)
        higher = local.pressure + step
        higher.setflags(write=False)
        slope: Array = (self._depth(replace(local, pressure=higher))[1] - depth) / step
        return slope


class GuardedEffect(Guard[Effect]):
    """An effect whose fields are finite, within their limits and there for each body.

    Its state lies on one of `bodies`, or in the contact.
    """

    def __init__(self, effect: Effect, bodies: Sequence[str] = ()) -> None:
        super().__init__(effect)
        self.requires = names_of(effect.requires)
        self.provides = effect.provides
        self.changes_load = type(effect).load_factor is not Effect.load_factor
        self.state_fields = tuple(effect.state_fields)
        self.carrier = self.ask(effect.carrier)
        if self.carrier is not None and self.carrier not in bodies:
            raise CaseError(
                f"{self} lies on {self.carrier!r}; the bodies are {', '.join(bodies)}", "effects"
            )
        given = self.ask(effect.initial_state)
        self.initial_state = _initial_state(self, self.state_fields, given)

    def body_of(self, field: Field) -> str | None:
        """Return the body that a state field lies on; None for the contact, or a uniform field."""
        return None if field.uniform else self.carrier

    def key_of(self, field: Field) -> str:
        """Return the key of a state field in `State.between`."""
        return key_of(field.name, self.body_of(field))

    def fields(self, contact: ContactConditions) -> dict[str, dict[str, Array]]:
        """Return each provided field for each body, shape (nx, ny)."""
        given = self.ask(self.component.fields, contact)
        answer = self.typed(given, Mapping, "its fields")
        found: dict[str, dict[str, Array]] = {field.name: {} for field in self.provides}
        when = "" if contact.speed > 0 else " at rest"
        for name, body in product(found, contact.materials):
            of_bodies = answer.get(name)
            values = of_bodies.get(body) if isinstance(of_bodies, Mapping) else None
            where = f" for body {body!r}{when}"
            if values is None:
                raise PluginError(f"{self} gave no {name!r}{where}")
            found[name][body] = self.array(name, values, contact.pressure.shape, where)
        for field in (FRICTION_COEFFICIENT, LOCAL_SLIP):
            of_bodies = found.get(field.name, {}).values()
            if any(not np.array_equal(one, other) for one, other in pairwise(of_bodies)):
                raise BadValues(
                    f"{self} gave each body a {field.name!r} of its own; it acts on both alike, so "
                    "give both the same"
                )
        return found

    def load_factor(self, snapshot: Snapshot) -> float:
        """Return the factor on the normal load."""
        return self.number("load_factor", self.ask(self.component.load_factor, snapshot))

    def state_rates(self, contact: ContactConditions) -> dict[str, Array]:
        """Return the change of each state field per second, (nx, ny), or (1, 1) if uniform."""
        window = contact.pressure.shape
        shapes = {f.name: (1, 1) if f.uniform else window for f in self.state_fields}
        return _rates(self, self.ask(self.component.state_rates, contact), shapes)


class GuardedSolver(Guard[ContactSolver]):
    """A contact solver whose pressures carry the load and stay below the cap."""

    def smallest_compliance(self, system: ContactSystem) -> float | None:
        """Return the smallest eigenvalue of K, in m/Pa, if the solver knows it."""
        answer = self.ask(self.component.smallest_compliance, system)
        return None if answer is None else self.number("smallest_compliance", answer)

    def solve(
        self, problem: ContactProblem, start: ContactSolution | None = None
    ) -> ContactSolution:
        """Solve `problem`, whose arrays the solver cannot write to."""
        return self._held(problem, self.ask(self.component.solve, _unwritable(problem), start))

    def solve_cycle(
        self,
        problems: Sequence[ContactProblem],
        starts: Sequence[ContactSolution],
        coupling: CycleCompliance | None = None,
    ) -> list[ContactSolution]:
        """Solve each position of a cycle; as `solve`."""
        asked = [_unwritable(problem) for problem in problems]
        if coupling is not None:
            bodies = [(readonly(compliance), cells) for compliance, cells in coupling.bodies]
            coupling = replace(coupling, shares=readonly(coupling.shares), bodies=bodies)
        answers: object = self.ask(self.component.solve_cycle, asked, starts, coupling)
        if not isinstance(answers, Sequence) or len(answers) != len(problems):
            raise PluginError(
                f"{self} gave a {type(answers).__name__} as the solutions of a cycle; it must be a "
                f"list of {len(problems)}, one for each position"
            )
        return [self._held(*pair) for pair in zip(problems, answers, strict=True)]

    def _held(self, problem: ContactProblem, given: object) -> ContactSolution:
        """Return what is held to the contract of an answer to `problem`."""
        answer: ContactSolution = self.typed(given, ContactSolution, "its solution")
        grid = problem.system.grid
        cap = problem.system.cap if problem.cap is None else problem.cap
        pressure = self.array("pressure", answer.pressure, grid.cells)
        overlap = self.array("overlap", answer.overlap, grid.cells)
        approach = self.number("approach", answer.approach)
        iterations = self.number("iterations", answer.iterations)
        residuals = vars(self.typed(answer.residuals, Residuals, "its residuals"))
        _, *claimed = self.array("residuals", list(residuals.values()), (3,)).tolist()
        carried = float(pressure.sum()) * grid.cell_area
        if not abs(carried - problem.load) <= SAME * problem.load:
            raise BadValues(
                f"{self} gave a pressure that carries {carried:.9g} N instead of "
                f"{problem.load:.9g} N"
            )
        if cap is not None and np.any(above := pressure > cap * (1 + SAME)):
            raise BadValues(
                f"{self} gave a pressure of {np.max(pressure[above]):.9g} Pa, above the hardness "
                f"of {np.min(cap):.9g} Pa that it says it honours"
            )
        force = abs(carried / problem.load - 1)
        return ContactSolution(
            pressure, approach, overlap, int(iterations), Residuals(force, *claimed)
        )


def _initial_state(
    who: GuardedLaw | GuardedEffect, fields: Sequence[Field], given: object
) -> dict[str, float]:
    """Return the initial value of each state field, in the order in which they are declared."""
    declared = [field.name for field in fields]
    if not isinstance(given, Mapping) or set(given) != set(declared):
        raise PluginError(
            f"{who} declares the state fields {sorted(declared)}, but starts with {given!r:.80}"
        )
    return {name: who.number(initial(name), given[name]) for name in declared}


def _rates(
    who: GuardedLaw | GuardedEffect, answer: object, shapes: Mapping[str, tuple[int, ...]]
) -> dict[str, Array]:
    """Return the rate of each state field, at its shape."""
    rates = who.typed(answer, Mapping, "rates of its state")
    for name in shapes:
        if name not in rates:
            raise PluginError(f"{who} gave no rate for its state field {name!r}")
    return {name: who.array(rate_of(name), rates[name], shapes[name]) for name in shapes}


def _unwritable(problem: ContactProblem) -> ContactProblem:
    wear = problem.wear
    if wear is not None:
        wear = WearCompliance(readonly(wear.local), readonly(wear.swept))
    cap = None if problem.cap is None else readonly(problem.cap)
    return ContactProblem(problem.system, readonly(problem.gap), problem.load, wear, cap)
