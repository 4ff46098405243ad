"""Gauss-Newton least squares in few runs, and profile-likelihood intervals."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from scipy.optimize import LinearConstraint, NonlinearConstraint, minimize
from scipy.special import chdtr, chdtri, stdtrit
from tribo import Array, CaseError, NumericalError
from tribo.kernel_api import OutOfWindow

from tribo_inverse.calibration.linearised import (
    COLLINEAR,
    Linearised,
    Problem,
    normalised,
    root_covariance,
)

STEP = 0.2
"""Change of a logarithm for a finite difference; large, since computed scars are rounded."""
LEAST_STEP = 0.05
"""The smallest difference that exceeds errors of the steps of a run."""
FAR = 20.0
"""Change of all data together, in standard deviations, beyond which a difference is shortened."""
TRUST_RADIUS = np.log(2.0)
"""Distance, in logarithms, up to which slopes are kept."""
PREDICTION_ERROR = 0.3
"""Error of a predicted step, relative to the step, up to which slopes are kept."""
OPEN = np.log(1e4)
"""Distance, in logarithms, beyond which the end of an interval counts as open."""
FEWEST_DEGREES_OF_FREEDOM = 0.5
"""Degrees of freedom below which a repeatability counts as unknown."""
CONVERGED = 0.01
"""Change of all data together, in standard deviations, that ends the fit; and the relative fall of
χ² that counts as progress."""
STALLED = 0.1
"""The change that ends the fit where χ² no longer falls, relative to the residuals."""
NUMERICAL = 0.5
"""The change that errors of the steps of a run may make, which ends it as well; no slopes are
updated for less."""
NO_EFFECT = 1e-3
"""Change of a datum, in standard deviations, per change of a parameter by a factor e, below which
nothing depends on the parameter."""
UNSEEN = 0.01
"""Computed value of an undetected loss, relative to its limit of detection."""
ABOVE_ROUNDING = 0.01
"""Relative change of a response, per change of a parameter by a factor e, above rounding."""
MOST_HALVINGS = 5
"""Halvings of a step whose scar outgrows the window."""
MOST_ROUNDS = 12
"""Rounds after which a fit fails."""
WITHOUT_PROGRESS, MOST_WITHOUT_PROGRESS = 2, 4
"""Rounds without a lower χ² after which a small change ends it, and after which it fails."""


class Unsettled(NumericalError):
    """A fit does not converge; `last` is its last model."""

    last: Linearised


def fit(
    model: Callable[[Array], Array],
    problem: Problem,
    start: Array,
    changes: Array | float = STEP,
) -> Linearised:
    """Return the model linearised about its last run, whose parameters are the estimate.

    Gauss-Newton in logarithms: each step goes to the least χ² of the linearised model. Slopes are
    finite differences, at first by `changes`, updated where they predicted a step badly or were
    taken far away. CaseError if no datum depends on a parameter; NumericalError if the estimate
    does not converge. A step that outgrows the window is halved.
    """
    origin = np.log(start)
    here = differenced(model, problem, origin, model(np.exp(origin)), changes)
    check_effect(here)
    if np.any(limited := here.limited()):
        origin = np.where(limited, _unseen(here), origin)
        problem = replace(problem, lower=np.where(limited, origin, problem.lower))
        here = differenced(model, problem, origin, model(np.exp(origin)), changes)
    least, without_progress, outgrown = np.inf, 0, None
    for rounds in range(1, MOST_ROUNDS + 1):  # noqa: B007
        here, point = here.best()
        before = here.residuals(here.point)
        change = float(np.linalg.norm(here.residuals(point) - before))
        if change > CONVERGED:
            point, responses, outgrown = _within(model, here.point, point)
            predicted = here.residuals(point)
            change = float(np.linalg.norm(predicted - before))
            residuals = problem.residuals(responses, here.weights)
            # Only the error in the column space of the Jacobian moves the next estimate.
            directions = np.linalg.svd(here.jacobian(point), full_matrices=False)[0]
            error = float(np.linalg.norm((residuals - predicted) @ directions))
            here = replace(here, point=point, responses=responses)
            if error > max(PREDICTION_ERROR * change, NUMERICAL):
                origin, here = point, differenced(model, problem, point, responses, steps(here))
            misfit = float(np.sum(residuals**2))
            without_progress = 0 if misfit < (1 - CONVERGED) * least else without_progress + 1
            least = min(least, misfit)
            # A wrong model cannot fit the data any better.
            small = max(NUMERICAL, STALLED * (least / len(problem.observed)) ** 0.5)
            if without_progress >= WITHOUT_PROGRESS and change < small:
                return here.best()[0]
            if without_progress == MOST_WITHOUT_PROGRESS:
                break
        elif np.max(np.abs(here.point - origin)) > TRUST_RADIUS:
            origin = here.point
            here = differenced(model, problem, origin, here.responses, steps(here))
        else:
            return here
    if outgrown:
        raise outgrown
    unsettled = Unsettled(
        f"the estimates have not settled after {rounds} rounds: χ² has come down to {least:.3g}, "
        f"and computed values still change by {change:.2g} of their uncertainty; refine "
        "grid.cells, lower stepping.depth_tolerance, start nearer, or state larger uncertainties"
    )
    unsettled.last = here
    raise unsettled


def interval(here: Linearised, direction: Array, level: float) -> tuple[float, float]:
    """Return the interval of direction · point, relative to its value at the last run.

    Profile likelihood: the smallest and largest value at points within the bounds whose χ² is at
    most its minimum plus the quantile of χ²₁, or of t² where the repeatability is estimated;
    infinite where the data do not bound it. The direction is a unit vector for a parameter, or the
    slopes of a response.
    """
    best = here.least(here.point)
    freedom = here.degrees_of_freedom(direction)
    t = stdtrit(freedom, 0.5 + 0.5 * level)
    rise = float(chdtri(1, 1 - level) if np.isinf(freedom) else t**2)
    least = float(np.sum(here.residuals(best) ** 2))
    root = root_covariance(here.sensitivity())
    # With point = best + root z, χ² rises to first order by |z|².
    gradient = np.sum(direction[:, None] * root, axis=0)
    spread = float(np.sqrt(np.sum(gradient**2)))
    if spread == 0:
        return 0.0, 0.0
    size, angles, directions = normalised(here.sensitivity())
    moves = directions[angles <= COLLINEAR] / size
    follows = np.abs(moves @ direction) > ABOVE_ROUNDING * np.linalg.norm(moves, axis=1)
    if spread > OPEN or freedom < FEWEST_DEGREES_OF_FREEDOM or np.any(follows):
        return -np.inf, np.inf
    lower, upper = here.bounds(2 * OPEN / np.clip(np.max(np.abs(direction)), 0.05, 1.0))

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
        return sign * (np.inf if far > OPEN else far)

    offset = float(np.sum(direction * (best - here.point)))
    return end(-1.0), end(1.0)


def limit(here: Linearised, axis: Array, level: float) -> float:
    """Return the upper end, relative to the last run, for a parameter that is `limited`.

    There values below all limits of detection have the probability 1 − level. Errors are taken at
    that end, as tests scatter in proportion to the parameter.
    """
    one_sided, end = float(chdtr(1, -2 * np.log1p(-level))), 0.0
    for _ in range(MOST_ROUNDS):
        former, end = end, interval(here, axis, one_sided)[1]
        if np.isinf(end) or abs(end - former) < 0.1 * CONVERGED:
            break
        here = here.weighed(here.point + end * axis, here.repeatability)
    return end


def steps(here: Linearised) -> Array:
    """Return the changes of the logarithms for differences at a run nearby."""
    size = normalised(here.sensitivity())[0]
    return np.asarray(np.clip(FAR / size, LEAST_STEP, STEP))


def differenced(
    model: Callable[[Array], Array],
    problem: Problem,
    point: Array,
    responses: Array,
    changes: Array | float = STEP,
) -> Linearised:
    """Return the model linearised about a run, by one more run for each parameter."""
    columns = []
    for i, far in enumerate(np.broadcast_to(changes, point.shape)):
        below, above = point[i] - problem.lower[i], problem.upper[i] - point[i]
        # Where bounds leave no room for a whole step, step to the farther bound.
        step = min(far, above) if above >= min(far, below) else -min(far, below)
        moved = point.copy()
        moved[i] += step
        moved, found, _ = _within(model, point, moved)
        change = problem.scaled(found) - problem.scaled(responses)
        columns.append(change / (moved[i] - point[i]))
    slopes = np.stack(columns, axis=1)
    return Linearised(problem, point, responses, slopes, weights=problem.weights())


def _within(
    model: Callable[[Array], Array], near: Array, far: Array
) -> tuple[Array, Array, OutOfWindow | None]:
    """Return a point from near to far, and its responses, whose scar does not outgrow the window.

    Also the error of a farther point. OutOfWindow if all points that are tried outgrow it.
    """
    outgrown = None
    for _ in range(MOST_HALVINGS):
        try:
            return far, model(np.exp(far)), outgrown
        except OutOfWindow as error:
            far, outgrown = 0.5 * (near + far), error
    return far, model(np.exp(far)), outgrown


def _unseen(here: Linearised) -> Array:
    """Return logarithms of parameters that give a hundredth of the limits of detection."""
    below = here.problem.below
    n = len(below)
    slopes = here.slopes[:n][below]
    wanted = np.log(UNSEEN * here.problem.observed[below] / here.responses[:n][below])
    moves = np.divide(wanted[:, None], slopes, out=np.full_like(slopes, np.inf), where=slopes > 0)
    least = here.point + np.min(moves, axis=0, initial=np.inf)
    return np.asarray(np.clip(least, here.problem.lower, here.problem.upper))


def check_effect(here: Linearised) -> None:
    """Check that some datum depends on each parameter; CaseError if none does."""
    sigma = here.problem.sigma[:, None]
    effects = np.max(np.abs(here.effects(here.point) / sigma), axis=0)
    for name, effect in zip(here.problem.names, effects, strict=True):
        if effect < NO_EFFECT:
            raise CaseError(
                f"a change of {name} by a factor e changes the measured values by {effect:.1g} of "
                "their uncertainty; leave it out of fit, measure something that depends on it, or "
                "check the units of the uncertainties"
            )
