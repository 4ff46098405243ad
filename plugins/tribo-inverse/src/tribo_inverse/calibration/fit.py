"""Gauss-Newton least squares in few runs, and profile-likelihood intervals."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.optimize import LinearConstraint, NonlinearConstraint, minimize
from scipy.special import chdtri, stdtrit
from tribo import Array, CaseError, NumericalError
from tribo.kernel_api import OutOfWindow

from tribo_inverse.calibration.linearised import (
    COLLINEAR,
    Linearised,
    Problem,
    Weights,
    normalised,
    root_covariance,
)

STEP = 0.2
"""Change of a logarithm for a finite difference; large, since computed scars are rounded."""
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
NUMERICAL = 0.5
"""The change that errors of the steps of a run may make: it ends a fit that makes no progress, and
no slopes are updated for less."""
NO_EFFECT = 1e-3
"""Change of a datum, in standard deviations, per change of a parameter by a factor e, below which
nothing depends on the parameter."""
ABOVE_ROUNDING = 0.01
"""Relative change of a response, per change of a parameter by a factor e, above rounding."""
MOST_HALVINGS = 5
"""Halvings of a step whose scar outgrows the window."""
MOST_ROUNDS = 12
"""Rounds after which a fit fails."""
WITHOUT_PROGRESS = 2
"""Rounds without a lower χ² after which a small change ends it."""


def fit(
    model: Callable[[Array], Array],
    problem: Callable[[Array], Problem],
    start: Array,
) -> Linearised:
    """Return the model linearised about its last run, whose parameters are the estimate.

    Gauss-Newton in logarithms: each step goes to the least χ² of the linearised model, weighted by
    the `problem` of the last run. Slopes are finite differences, updated where they predicted a
    step badly or were taken far away. CaseError if no datum depends on a parameter; NumericalError
    if the estimate does not converge. A step that outgrows the window is halved.
    """
    origin, responses = np.log(start), model(np.exp(np.log(start)))
    here = differenced(model, problem(np.exp(origin)), origin, responses)
    check_effect(here)
    least, without_progress, outgrown = np.inf, 0, None
    for rounds in range(1, MOST_ROUNDS + 1):  # noqa: B007
        here, point = here.best()
        before = here.residuals(here.point)
        change = float(np.linalg.norm(here.residuals(point) - before))
        if without_progress >= WITHOUT_PROGRESS and change < NUMERICAL:
            return here
        if change > CONVERGED:
            point, responses, outgrown = _within(model, here.point, point)
            predicted = here.residuals(point)
            change = float(np.linalg.norm(predicted - before))
            residuals = here.problem.residuals(responses, here.weights)
            # Only the error in the column space of the Jacobian moves the next estimate.
            directions = np.linalg.svd(here.jacobian(point), full_matrices=False)[0]
            error = float(np.linalg.norm((residuals - predicted) @ directions))
            misfit = float(np.sum(residuals**2))
            without_progress = 0 if misfit < (1 - CONVERGED) * least else without_progress + 1
            least = min(least, misfit)
            here = here.about(point, responses, problem(np.exp(point)))
            if error <= max(PREDICTION_ERROR * change, NUMERICAL):
                continue
        elif np.max(np.abs(here.point - origin)) <= TRUST_RADIUS:
            return here
        origin = here.point
        here = differenced(model, here.problem, origin, here.responses)
    if outgrown:
        raise outgrown
    raise NumericalError(
        f"the estimates have not settled after {rounds} rounds: χ² has come down to {least:.3g}, "
        f"and computed values still change by {change:.2g} of their uncertainty; refine "
        "grid.cells, lower stepping.depth_tolerance, start nearer, or state larger uncertainties"
    )


def interval(here: Linearised, direction: Array, level: float) -> tuple[float, float]:
    """Return the interval of direction · point, relative to its value at the last run.

    Profile likelihood: the smallest and largest value at points within the bounds whose χ² is at
    most its minimum plus the quantile of χ²₁, or of t² where the repeatability is estimated;
    infinite where the data do not bound it. The direction is a unit vector for a parameter, or the
    slopes of a response.
    """
    best = here.least()
    freedom = here.degrees_of_freedom(direction)
    t = stdtrit(freedom, 0.5 + 0.5 * level)
    rise = float(chdtri(1, 1 - level) if np.isinf(freedom) else t**2)
    least = float(np.sum(here.residuals(best) ** 2))
    root = root_covariance(here.jacobian())
    # With point = best + root z, χ² rises to first order by |z|².
    gradient = np.sum(direction[:, None] * root, axis=0)
    spread = float(np.sqrt(np.sum(gradient**2)))
    if spread == 0:
        return 0.0, 0.0
    size, angles, directions = normalised(here.jacobian())
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


def differenced(
    model: Callable[[Array], Array],
    problem: Problem,
    point: Array,
    responses: Array,
) -> Linearised:
    """Return the model linearised about a run, by one more run for each parameter."""
    columns = []
    for i in range(len(point)):
        below, above = point[i] - problem.lower[i], problem.upper[i] - point[i]
        # Where bounds leave no room for a whole step, step to the farther bound.
        step = min(STEP, above) if above >= min(STEP, below) else -min(STEP, below)
        moved = point.copy()
        moved[i] += step
        moved, found, _ = _within(model, point, moved)
        change = problem.scaled(found) - problem.scaled(responses)
        columns.append(change / (moved[i] - point[i]))
    slopes = np.stack(columns, axis=1)
    return Linearised(problem, point, responses, slopes, Weights.of(problem.sigma))


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
