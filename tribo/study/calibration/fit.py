"""Least squares in few runs, and the intervals of what was fitted."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from scipy.optimize import LinearConstraint, NonlinearConstraint, minimize
from scipy.special import chdtri, stdtrit

from tribo.core.arrays import Array
from tribo.core.errors import CaseError, NumericalError
from tribo.study.calibration.linearised import Linearised, Problem, root_covariance

STEP = 0.2
"""Relative change of a parameter for a difference; a scar must grow by more than rounding."""
FAR, FORETOLD = np.log(2.0), 0.3
"""How far, in the logarithm, slopes are trusted, and up to which error of what they foretold."""
REACH = np.log(1e4)
"""How far an interval is followed; beyond, the data leave it open."""
FEW = 0.5
"""Degrees of freedom below which a scatter is as good as unknown."""
SETTLED, HARDLY = 0.01, 0.1
"""Change of all data together, in standard deviations, that ends the fit; the second if χ² stays
the same. The first is also the part of χ² that counts as a fall."""
NO_EFFECT = 1e-3
"""Change of a datum, in standard deviations, per change of a parameter by e: nothing to learn."""
UNSEEN = 0.01
"""What is computed for a loss that was not seen, in parts of its limit."""
ABOVE_ROUNDING = 0.01
"""Relative change of a datum, per change of a parameter by e, that is above rounding."""
MOST_ROUNDS, MOST_IN_VAIN = 12, 4
"""Rounds, and rounds without a lower misfit, after which a fit is given up."""


def fit(model: Callable[[Array], Array], problem: Problem, start: Array) -> Linearised:
    """Return the model about its last run, whose parameters are the estimate.

    By Gauss-Newton steps in logarithms, each to the least χ² of the linearised model. Its slopes
    are differences, taken anew where they foretold a step badly or were taken far away. CaseError
    if a parameter changes none of the data; NumericalError if the estimate does not settle.
    """
    known = np.log(start)
    here = differenced(model, problem, known, model(np.exp(known)))
    check_effect(here)
    if np.any(limited := here.limited()):
        known = np.where(limited, _as_good_as_none(here), known)
        problem = replace(problem, lower=np.where(limited, known, problem.lower))
        here = differenced(model, problem, known, model(np.exp(known)))
    least, in_vain = np.inf, 0
    for rounds in range(1, MOST_ROUNDS + 1):  # noqa: B007
        here, point = here.best()
        foretold = here.residuals(point)
        shift = np.linalg.norm(foretold - here.residuals(here.point))
        if shift > SETTLED:
            responses = model(np.exp(point))
            residuals = problem.residuals(responses, here.weights)
            # What of the error moves the next estimate.
            directions = np.linalg.svd(here.jacobian(point), full_matrices=False)[0]
            error = np.linalg.norm((residuals - foretold) @ directions)
            here = replace(here, point=point, responses=responses)
            if error > FORETOLD * shift:
                known, here = point, differenced(model, problem, point, responses)
            misfit = float(np.sum(residuals**2))
            in_vain = 0 if misfit < (1 - SETTLED) * least else in_vain + 1
            least = min(least, misfit)
            if in_vain == MOST_IN_VAIN:
                # Where the model is wrong more is not to be had of it.
                if shift > HARDLY * max(1.0, (least / len(problem.observed)) ** 0.5):
                    break
                return here.best()[0]
        elif np.max(np.abs(here.point - known)) > FAR:
            known = here.point
            here = differenced(model, problem, known, here.responses)
        else:
            return here
    raise NumericalError(
        f"the estimates have not settled after {rounds} rounds: χ² has come down to {least:.3g}, "
        f"and computed values still change by {shift:.2g} of their uncertainty; refine "
        "grid.cells, start nearer, or state the uncertainties larger"
    )


def interval(here: Linearised, direction: Array, level: float) -> tuple[float, float]:
    """Return the interval of direction · point, relative to its value at the last run.

    By the profile likelihood: the least and the largest value at the points within the bounds
    whose χ² is at most its minimum plus the quantile of χ²₁, or that of t² where the repeatability
    is estimated; infinite where the data leave it open. The direction is a unit vector for a
    parameter, or the slopes of a response.
    """
    best = here.least(here.point)
    freedom = here.freedom(direction)
    t = stdtrit(freedom, 0.5 + 0.5 * level)
    rise = float(chdtri(1, 1 - level) if np.isinf(freedom) else t**2)
    least = float(np.sum(here.residuals(best) ** 2))
    root = root_covariance(here.sensitivity())
    # With point = best + root z, χ² rises to first order by |z|².
    gradient = np.sum(direction[:, None] * root, axis=0)
    spread = float(np.sqrt(np.sum(gradient**2)))
    if spread == 0:
        return 0.0, 0.0
    if spread > REACH or freedom < FEW:
        return -np.inf, np.inf
    lower, upper = here.bounds(2 * REACH / np.clip(np.max(np.abs(direction)), 0.05, 1.0))

    def point(z: Array) -> Array:
        return np.asarray(best + np.sum(root * z, axis=1))

    def room(z: Array) -> float:
        return rise - float(np.sum(here.residuals(point(z)) ** 2) - least)

    def room_slopes(z: Array) -> Array:
        at = point(z)
        steepest = np.sum(here.residuals(at)[:, None] * here.jacobian(at), axis=0)
        return np.asarray(-2 * np.sum(steepest[:, None] * root, axis=0))

    within = (
        NonlinearConstraint(room, 0.0, np.inf, jac=room_slopes),
        LinearConstraint(root, lower - best, upper - best),
    )

    def end(sign: float) -> float:
        found = minimize(
            lambda z: -sign * float(np.sum(gradient * z)) / spread,
            sign * np.sqrt(rise) * gradient / spread,
            jac=lambda z: -sign * gradient / spread,
            method="SLSQP",
            constraints=within,
            options={"ftol": 1e-5, "maxiter": 200},
        )
        far = sign * offset - float(found.fun) * spread
        return sign * (np.inf if far > REACH else far)

    offset = float(np.sum(direction * (best - here.point)))
    return end(-1.0), end(1.0)


def differenced(
    model: Callable[[Array], Array], problem: Problem, point: Array, responses: Array
) -> Linearised:
    """Return the model linearised about a run, by a run more for each parameter."""
    columns = []
    for i in range(len(point)):
        below, above = point[i] - problem.lower[i], problem.upper[i] - point[i]
        # If bounds leave no room for a whole step, take the larger part of it.
        step = min(STEP, above) if above >= min(STEP, below) else -min(STEP, below)
        moved = point.copy()
        moved[i] += step
        change = problem.scaled(model(np.exp(moved))) - problem.scaled(responses)
        columns.append(change / step)
    slopes = np.stack(columns, axis=1)
    return Linearised(problem, point, responses, slopes, weights=problem.weights())


def _as_good_as_none(here: Linearised) -> Array:
    """Return logarithms of parameters at which what was not seen is a hundredth of its limit."""
    below = here.problem.below
    n = len(below)
    slopes = here.slopes[:n][below]
    wanted = np.log(UNSEEN * here.problem.observed[below] / here.responses[:n][below])
    moves = np.divide(wanted[:, None], slopes, out=np.full_like(slopes, np.inf), where=slopes > 0)
    least = here.point + np.min(moves, axis=0, initial=np.inf)
    return np.asarray(np.clip(least, here.problem.lower, here.problem.upper))


def check_effect(here: Linearised) -> None:
    """Check that each parameter changes some of the data; CaseError if one does not."""
    sigma = here.problem.sigma[:, None]
    effects = np.max(np.abs(here.effects(here.point) / sigma), axis=0)
    for name, effect in zip(here.problem.names, effects, strict=True):
        if effect < NO_EFFECT:
            raise CaseError(
                f"a change of {name} by a factor e changes the measured values by {effect:.1g} of "
                "their uncertainty; leave it out of fit, measure something that depends on it, or "
                "check the units of the uncertainties"
            )
