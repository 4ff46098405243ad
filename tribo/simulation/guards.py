"""The parts of a case, each held to its contract at every call."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from tribo.contact.solver import ContactSolver
from tribo.core.arrays import Array, readonly
from tribo.core.contact import (
    ContactProblem,
    ContactSolution,
    ContactSystem,
    Residuals,
    WearCompliance,
)
from tribo.core.errors import BadValues, PluginError
from tribo.core.fields import ContactConditions, LocalConditions, WearRate
from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.effects.effect import Effect
from tribo.motion.cycle import Position, Speeds
from tribo.motion.exposure import Exposure
from tribo.motion.kinematics import Kinematics
from tribo.simulation.guard import Guard
from tribo.surfaces.surface import Surface
from tribo.wear.law import WearLaw

NUDGE = 1e-6
"""Part of the largest pressure by which it is raised to find a slope that a law leaves out."""
LOAD_BALANCE = 1e-6
ABOVE_CAP = 1e-6
SAMPLES = 8
INVERSE = 1e-6
WHOLE = 1e-9


class GuardedSurface(Guard[Surface]):
    """A surface and what it answered: its height (nx, ny) in m, and its curvature in 1/m.

    Raises
    ------
    PluginError
        If these are not what they must be.
    """

    def __init__(self, surface: Surface, body: str, grid: Grid) -> None:
        super().__init__(surface, body)
        height = self.ask(surface.height, grid)
        self.height = self.field("a height map", height, grid.cells)[0]
        self.curvature = self._curvature()

    def _curvature(self) -> tuple[float, float] | None:
        answer: object = self.ask(getattr, self.component, "curvature")
        if answer is None:
            return None
        along, across = self.field("a curvature", answer, (2,))[0]
        return float(along), float(across)


class GuardedLaw(Guard[WearLaw]):
    """A wear law that suits its body, and the initial values of its state fields.

    Raises
    ------
    CaseError
        If the law refuses the material.
    PluginError
        If its state is not as it declares it.
    """

    def __init__(self, law: WearLaw, body: str, material: Material) -> None:
        super().__init__(law, body)
        self.material = material
        self.requires = law.requires
        self.state_fields = law.state_fields
        self.ask(law.check, material)
        given = self.ask(law.initial_state)
        declared = {field.name for field in law.state_fields}
        if not isinstance(given, Mapping) or set(given) != declared:
            raise PluginError(
                f"{self} declares the state fields {sorted(declared)}, but starts with "
                f"{given!r:.80}"
            )
        self.initial_state = {
            name: self.number(f"an initial {name!r}", value) for name, value in given.items()
        }

    def rate(self, local: LocalConditions) -> WearRate:
        """Return the law's rate at the shape of the pressure, its slope not negative.

        Raises
        ------
        BadValues
            If an array is not finite or of another shape, or the depth is
            negative, or not 0 where the pressure is.
        PluginError
            If the answer is anything else but such arrays.
        """
        answer, depth = self._depth(local)
        shape = local.pressure.shape
        slope = answer.depth_slope
        if slope is None:
            slope = self._slope(local, depth)
        slope, flattest, _ = self.field("a derivative", slope, shape, spread=True)
        rates = answer.state_rates
        if not isinstance(rates, Mapping):
            raise self.wrong(rates, "as rates of its state")
        state = {}
        for name in self.initial_state:
            if name not in rates:
                raise PluginError(f"{self} gave no rate for its state field {name!r}")
            state[name] = self.field(f"a rate of {name!r}", rates[name], shape, spread=True)[0]
        return WearRate(depth, np.maximum(slope, 0.0) if flattest < 0 else slope, state)

    def _depth(self, local: LocalConditions) -> tuple[WearRate, Array]:
        answer = self.ask(self.component.rate, local)
        if not isinstance(answer, WearRate):
            raise self.wrong(answer, "instead of a WearRate")
        what, pressure = "a depth per metre", local.pressure
        depth, least, _ = self.field(what, answer.depth_rate, pressure.shape, spread=True)
        if least < 0:
            raise BadValues(f"{self} gave a negative {what[2:]} ({least:.3g}); wear only removes")
        bare = np.count_nonzero((depth != 0) & (pressure == 0))
        if bare:
            raise BadValues(
                f"{self} gave {what} that is not 0 in {bare} cells where the pressure is 0; what "
                "is not touched does not wear"
            )
        return answer, depth

    def _slope(self, local: LocalConditions, depth: Array) -> Array:
        """Return the derivative of the depth in pressure, by a finite step up."""
        step = NUDGE * float(np.max(local.pressure))
        higher = local.pressure + step
        higher.setflags(write=False)
        slope: Array = (self._depth(replace(local, pressure=higher))[1] - depth) / step
        return slope


class GuardedEffect(Guard[Effect]):
    """An effect whose fields are finite, within their limits and there for each body."""

    def __init__(self, effect: Effect) -> None:
        super().__init__(effect)
        self.requires = effect.requires
        self.provides = effect.provides

    def fields(self, contact: ContactConditions) -> dict[str, dict[str, Array]]:
        """Return each provided field for each body, shape (nx, ny).

        Raises
        ------
        BadValues
            If one is not finite, of another shape or beyond its limits.
        PluginError
            If one is missing.
        """
        answer = self.ask(self.component.fields, contact)
        if not isinstance(answer, Mapping):
            raise self.wrong(answer, "instead of its fields")
        found: dict[str, dict[str, Array]] = {}
        for field in self.provides:
            of_bodies = answer.get(field.name, {})
            found[field.name] = {}
            for body in contact.materials:
                values = of_bodies.get(body) if isinstance(of_bodies, Mapping) else None
                what = f"{field.name!r} for body {body!r}"
                if values is None:
                    raise PluginError(f"{self} gave no {what}")
                shape = contact.pressure.shape
                array, low, high = self.field(what, values, shape, spread=True)
                if outside := field.outside(low, high):
                    raise BadValues(f"{self} gave {what} that is {outside}")
                found[field.name][body] = array
        return found


class GuardedSolver(Guard[ContactSolver]):
    """A contact solver whose pressures carry the load and stay below the cap."""

    def smallest_compliance(self, system: ContactSystem) -> float | None:
        """Return the smallest eigenvalue of K, in m/Pa, if the solver knows it."""
        answer = self.ask(self.component.smallest_compliance, system)
        return None if answer is None else self.number("a smallest compliance", answer)

    def solve(
        self, problem: ContactProblem, start: ContactSolution | None = None
    ) -> ContactSolution:
        """Solve `problem`, whose arrays the solver cannot write to.

        Raises
        ------
        BadValues
            If the answer has a field that is not finite, negative or of another
            shape, does not carry the load, or exceeds the cap.
        PluginError
            If it is not a solution at all.
        NumericalError
            If the solver gives up.
        """
        wear = problem.wear
        if wear is not None:
            wear = WearCompliance(readonly(wear.local), readonly(wear.swept))
        asked = ContactProblem(problem.system, readonly(problem.gap), problem.load, wear)
        answer = self.ask(self.component.solve, asked, start)
        if not isinstance(answer, ContactSolution):
            raise self.wrong(answer, "instead of a ContactSolution")
        if not isinstance(answer.residuals, Residuals):
            raise self.wrong(answer.residuals, "instead of Residuals")
        grid, cap = problem.system.grid, problem.system.cap
        pressure, lowest, highest = self.field("a pressure", answer.pressure, grid.cells)
        overlap, least, _ = self.field("an overlap", answer.overlap, grid.cells)
        for what, low in (("pressure", lowest), ("overlap", least)):
            if low < 0:
                raise BadValues(f"{self} gave a negative {what} ({low:.3g})")
        carried = float(pressure.sum()) * grid.cell_area
        if not abs(carried - problem.load) <= LOAD_BALANCE * problem.load:
            raise BadValues(
                f"{self} gave a pressure that carries {carried:.9g} N instead of "
                f"{problem.load:.9g} N"
            )
        if cap is not None and highest > cap * (1 + ABOVE_CAP):
            raise BadValues(
                f"{self} gave a pressure of {highest:.9g} Pa, above the hardness of {cap:.9g} Pa "
                "that it says it honours"
            )
        _, *claimed = (
            self.number(f"a residual of {what}", getattr(answer.residuals, what))
            for what in ("force", "complementarity", "penetration")
        )
        return ContactSolution(
            pressure=pressure,
            approach=self.number("an approach", answer.approach),
            overlap=overlap,
            iterations=int(self.number("a number of iterations", answer.iterations)),
            residuals=Residuals(abs(carried / problem.load - 1), *claimed),
        )


class GuardedMotion(Guard[Kinematics]):
    """A motion of which every answer is checked."""

    def cycle(self, grid: Grid) -> tuple[Position, ...]:
        """Return the positions of a cycle.

        Raises
        ------
        PluginError
            If their shares or speeds are not what they must be.
        """
        answer = self.ask(lambda: tuple(self.component.cycle(grid)))
        if not answer or not all(isinstance(position, Position) for position in answer):
            raise self.wrong(answer, "as positions of its cycle")
        shares = [self.number("a share of the path", position.share) for position in answer]
        if min(shares) < 0 or abs(sum(shares) - 1) > WHOLE:
            raise BadValues(
                f"{self} gave shares of the path that add up to {sum(shares):g}, not to 1"
            )
        return tuple(
            Position(share, self._speeds(position.speeds), self._reach(position.reach, grid))
            for share, position in zip(shares, answer, strict=True)
        )

    def _reach(self, answer: Array | None, grid: Grid) -> Array | None:
        if answer is None:
            return None
        what = "a sliding distance of each row"
        reach, least, _ = self.field(what, answer, grid.cells[1:])
        if least <= 0:
            raise BadValues(f"{self} gave {what} of which one is not positive ({least:.3g})")
        return reach

    def _speeds(self, answer: Speeds | None) -> Speeds | None:
        if answer is None:
            return None
        what = "speeds of a cycle with their shares of the distance"
        pairs, least, _ = self.field(what, answer, (self.ask(len, answer), 2))
        if least < 0:
            raise BadValues(f"{self} gave {what} of which one is negative ({least:.3g})")
        total = float(sum(pairs[:, 1]))
        if abs(total - 1) > WHOLE:
            raise BadValues(
                f"{self} gave shares of the distance that add up to {total:g}, not to 1"
            )
        return [(float(speed), float(share)) for speed, share in pairs]

    def exposures(self, grid: Grid, bodies: Sequence[str]) -> dict[str, GuardedExposure]:
        """Return how each body meets the contact.

        Raises
        ------
        PluginError
            If there is not just one exposure for each body.
        """
        answer = self.ask(self.component.exposures, grid, bodies)
        if not isinstance(answer, Mapping) or set(answer) != set(bodies):
            given = list(answer) if isinstance(answer, Mapping) else f"a {type(answer).__name__}"
            raise PluginError(
                f"{self} gave exposures of {given}, but the bodies are {list(bodies)}"
            )
        for body, exposure in answer.items():
            if not isinstance(exposure, Exposure):
                raise self.wrong(exposure, f"as exposure of body {body!r}")
        return {body: GuardedExposure(answer[body], self.component, body, grid) for body in bodies}

    def end_time(self, distance: float | None) -> float:
        """Return when the motion ends, or has slid `distance` (m) if that is sooner, in s."""
        end = self.number("an end", self.ask(getattr, self.component, "end_time"))
        if distance is not None:
            end = min(end, self.time_at(distance))
        if end <= 0:
            raise PluginError(f"{self} ends at {end:g} s, before it begins")
        return end

    def distance_at(self, time: float) -> float:
        """Return the sliding distance from 0 to `time` (s), in m."""
        return self.number(f"a distance at {time:g} s", self.ask(self.component.distance_at, time))

    def time_at(self, distance: float) -> float:
        """Return the time at which it has slid `distance` (m), in s."""
        return self.number(f"a time at {distance:g} m", self.ask(self.component.time_at, distance))

    def check_distance(self, end: float) -> None:
        """Refuse a distance that does not grow from 0 to `end` (s), or is not `time_at`'s inverse.

        A few times are tried; a run checks the ones it comes to.
        """
        start, total = self.distance_at(0.0), self.distance_at(end)
        if start != 0 or not total > 0:
            raise PluginError(
                f"{self} slides from {start:g} m to {total:g} m; it must slide on from 0"
            )
        for part in range(1, SAMPLES + 1):
            distance = total * part / SAMPLES
            time = self.time_at(distance)
            reached = self.distance_at(time)
            if not (time >= 0 and abs(reached - distance) <= INVERSE * total):
                raise PluginError(
                    f"{self} puts {distance:g} m at {time:g} s, but has slid {reached:g} m by "
                    "then: its time is not the inverse of its distance"
                )

    def check_contact(self, half_width_x: float) -> None:
        """Raise `CaseError` if its averaging makes no sense for the first contact."""
        self.ask(self.component.check_contact, half_width_x)

    def limitation(
        self, half_width_x: float, depth: float, approach: float, volume_ratio: float
    ) -> str | None:
        """Return why its averaging no longer holds, if so; see `Kinematics.limitation`."""
        asked = self.component.limitation
        answer = self.ask(asked, half_width_x, depth, approach, volume_ratio)
        if not isinstance(answer, str | None):
            raise self.wrong(answer, "as its limitation")
        return answer


class GuardedExposure(Guard[Kinematics]):
    """An exposure of which every answer is checked; what is wrong names the motion it is from."""

    def __init__(self, exposure: Exposure, motion: Kinematics, body: str, grid: Grid) -> None:
        super().__init__(motion)
        self.swept = exposure.swept
        self.shape_stays = exposure.shape_stays
        self._asked = exposure
        self._whose = body
        self._cells = grid.cells
        self.starts = exposure.starts
        self.rows = exposure.rows or grid.cells[0]
        self._own = (self.rows, grid.cells[1])

    def __str__(self) -> str:
        """Return what messages call it."""
        return f"{super().__str__()}, for body {self._whose!r},"

    def average(self, rate: Array) -> Array:
        """Return the rate each point of the body sees."""
        asked = readonly(rate)
        answer = self.ask(self._asked.average, asked)
        if answer is asked and (self.starts is not None or not self.swept):
            # What was held to the contract as a law's answer.
            return asked
        average, least, _ = self.field("an average", answer, self._own)
        if least < 0 <= np.min(rate):
            raise BadValues(
                f"{self} gave a negative average ({least:.3g}) of what is nowhere negative"
            )
        return average

    def envelope(self, field: Array) -> Array:
        """Return the largest value each point of the body meets, on its own surface."""
        return self.field(
            "an envelope", self.ask(self._asked.envelope, readonly(field)), self._own
        )[0]

    def volume(self, depth: Array) -> float:
        """Return the volume of a depth on the body's own surface, in m³."""
        return self.number("a volume", self.ask(self._asked.volume, readonly(depth)))

    def compliance(self, derivative: Array, pressure: Array) -> WearCompliance | None:
        """Return the wear per metre of sliding as a compliance, or None."""
        asked = readonly(derivative)
        answer = self.ask(self._asked.compliance, asked, readonly(pressure))
        if answer is None:
            return None
        if not isinstance(answer, WearCompliance):
            raise self.wrong(answer, "instead of a WearCompliance")
        local, least = answer.local, 0.0
        if local is not asked:
            local, least, _ = self.field("a local compliance", local, self._cells)
        swept, lowest, _ = self.field("a swept compliance", answer.swept, self._cells[1:])
        if min(least, lowest) < 0:
            raise BadValues(f"{self} gave a negative compliance ({min(least, lowest):.3g})")
        return WearCompliance(local, swept)
