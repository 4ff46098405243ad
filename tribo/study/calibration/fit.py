"""Least squares in few runs: a surrogate of the model, and what the data say by it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import OptimizeResult, brentq, least_squares
from scipy.special import chdtri

from tribo.core.arrays import Array, Mask
from tribo.core.errors import CaseError, NumericalError

STEP = 0.2
"""Relative change of a parameter for a difference; a scar must grow by more than rounding."""
FAR = np.log(2.0)
"""How far, in the logarithm, slopes are trusted before they are differenced anew."""
LEAP = np.log(100.0)
"""How far a parameter may move between two runs."""
REACH = np.log(1e4)
"""How far an interval is followed; beyond, the data leave it open."""
SETTLED = 0.01
"""Change of the responses, in standard deviations, that ends the fit; and part of χ² to gain."""
HARDLY = 0.1
"""The same once the misfit does not come down any more."""
NO_EFFECT = 1e-3
"""Change of a datum, in standard deviations, per change of a parameter by e: nothing to learn."""
NOTABLE = 0.01
"""Relative change of a datum, per change of a parameter by e, that is none of rounding."""
MOST_ROUNDS = 12
MOST_IN_VAIN = 4
"""Rounds without a lower misfit after which a fit is given up."""
_PULL = 1e-3
_RIDGE = 1e-12


@dataclass(frozen=True)
class Problem:
    """What is to be fitted.

    Parameters
    ----------
    names : tuple of str
        What the parameters are called in messages.
    observed : ndarray, shape (n,)
        Measured values.
    sigma : ndarray, shape (n,)
        Their standard deviations.
    logged : ndarray of bool, shape (m,)
        Which of the model's responses are positive and near to power laws of
        the parameters. The first n responses answer to `observed`.
    lower, upper : ndarray, shape (p,)
        Bounds of the logarithms of the parameters; infinite for none.
    """

    names: tuple[str, ...]
    observed: Array
    sigma: Array
    logged: Mask
    lower: Array
    upper: Array

    def residuals(self, responses: Array) -> Array:
        """Return the misfit of the first n responses, in standard deviations."""
        return (responses[: len(self.observed)] - self.observed) / self.sigma


@dataclass(frozen=True)
class Surrogate:
    """The model near a run: power laws where `Problem.logged`, else linear in the logarithms.

    Worn volumes, depths and widths go as powers of the wear coefficients: the
    volume by Archard's law exactly as the first.

    Parameters
    ----------
    problem : Problem
        What is fitted.
    point : ndarray, shape (p,)
        Logarithms of the parameters of the run.
    responses : ndarray, shape (m,)
        What the run gave.
    slopes : ndarray, shape (m, p)
        Derivatives by the logarithms of the parameters: of the logarithm of a
        response where logged, else of itself.
    """

    problem: Problem
    point: Array
    responses: Array
    slopes: Array

    def at(self, point: Array) -> Array:
        """Return the responses at another point."""
        moved = np.sum(self.slopes * (point - self.point), axis=1)
        logged = self.problem.logged
        return np.where(
            logged, self.responses * np.exp(np.where(logged, moved, 0.0)), self.responses + moved
        )

    def residuals(self, point: Array) -> Array:
        """Return the misfit of the data, in standard deviations."""
        return self.problem.residuals(self.at(point))

    def jacobian(self, point: Array) -> Array:
        """Return the derivatives of `residuals`, shape (n, p)."""
        n = len(self.problem.observed)
        factor = np.where(self.problem.logged, self.at(point), 1.0)[:n] / self.problem.sigma
        return np.asarray(factor[:, None] * self.slopes[:n])

    def closest(self, target: tuple[Array, float, float] | None = None) -> OptimizeResult:
        """Return the least-squares point within the bounds and a leap.

        `target` = (direction, value, width) also draws direction · point to a
        value.
        """
        reach = LEAP
        if target is not None:
            # Wide enough that only true bounds stop what follows the direction.
            reach = 2 * REACH / np.clip(np.max(np.abs(target[0])), 0.05, 1.0)
        lower = np.maximum(self.problem.lower, self.point - reach)
        upper = np.minimum(self.problem.upper, self.point + reach)

        def residuals(point: Array) -> Array:
            own = self.residuals(point)
            if target is None:
                return own
            direction, value, width = target
            return np.append(own, (np.sum(direction * point) - value) / width)

        def jacobian(point: Array) -> Array:
            own = self.jacobian(point)
            return own if target is None else np.vstack([own, target[0] / target[2]])

        start = np.clip(self.point, lower, upper)
        return least_squares(
            residuals, start, jacobian, (lower, upper), xtol=1e-10, ftol=1e-10, gtol=1e-10
        )

    def updated(self, point: Array, responses: Array) -> Surrogate:
        """Return the surrogate about a new run, its slopes corrected by Broyden's formula."""
        step = point - self.point
        error = _change(self.problem, self.responses, responses) - np.sum(
            self.slopes * step, axis=1
        )
        slopes = self.slopes + error[:, None] * step / np.sum(step**2)
        return replace(self, point=point, responses=responses, slopes=slopes)


def fit(
    model: Callable[[Array], Array],
    problem: Problem,
    start: Array,
    first: Array | None = None,
) -> Surrogate:
    """Fit the parameters by Gauss-Newton on a surrogate, a run of the model a round.

    Slopes come from differences about the first run, then from Broyden's
    formula, and from differences again about an estimate that lies far off.

    Parameters
    ----------
    model : callable
        Responses, shape (m,), for parameters, shape (p,).
    problem : Problem
        What is fitted.
    start : ndarray, shape (p,)
        Parameters to begin with; positive.
    first : ndarray, shape (m,), optional
        The model's responses for them, if known.

    Returns
    -------
    Surrogate
        About the last run, whose parameters are the estimate.

    Raises
    ------
    CaseError
        If a parameter changes none of the data.
    NumericalError
        If the estimate does not settle.

    References
    ----------
    Broyden, C. G. (1965), A class of methods for solving nonlinear
    simultaneous equations, Math. Comput. 19, 577-593.
    """

    def run(point: Array) -> Array:
        return model(np.exp(point))

    point = np.log(start)
    here = _differenced(run, problem, point, run(point) if first is None else first)
    _check_effect(here)
    known = point
    least, in_vain = np.inf, 0
    for rounds in range(1, MOST_ROUNDS + 1):  # noqa: B007
        point = here.closest().x
        shift = np.max(np.abs(here.residuals(point) - here.residuals(here.point)))
        if shift > SETTLED:
            here = here.updated(point, run(point))
            misfit = float(np.sum(here.residuals(point) ** 2))
            in_vain = 0 if misfit < (1 - SETTLED) * least else in_vain + 1
            least = min(least, misfit)
            if in_vain == MOST_IN_VAIN:
                if shift > HARDLY:
                    break
                return here
        elif np.max(np.abs(here.point - known)) > FAR:
            known = here.point
            here = _differenced(run, problem, known, here.responses)
        else:
            return here
    raise NumericalError(
        f"the estimates have not settled after {rounds} rounds: χ² has come down to {least:.3g}, "
        f"and a computed value still changes by {shift:.2g} of its uncertainty; refine "
        "grid.cells, start nearer, or state the uncertainties larger"
    )


def covariance(jacobian: Array) -> Array:
    """Return (JᵀJ)⁻¹, very large but finite where the data tell nothing."""
    root = _root(jacobian)
    return np.asarray(root @ root.T)


def _root(jacobian: Array) -> Array:
    """Return the matrix whose product with its transpose is the covariance, shape (p, p)."""
    size = np.sqrt(np.sum(jacobian**2, axis=0))
    _, values, directions = np.linalg.svd(jacobian / size, full_matrices=False)
    return np.asarray(directions.T / np.sqrt(values**2 + _RIDGE) / size[:, None])


def interval(here: Surrogate, direction: Array, level: float) -> tuple[float, float]:
    """Return how far direction · point may lie below and above that of the surrogate's run.

    By the profile likelihood: all values that some point with χ² less than its
    minimum plus the quantile of χ²₁ gives. It does not depend on how the
    parameters are scaled and keeps within the bounds; infinite where the data
    leave it open.

    Parameters
    ----------
    here : Surrogate
        About the estimate.
    direction : ndarray, shape (p,)
        A unit vector for a parameter, or the slopes of a response.
    level : float
        Probability with which it covers the truth.
    """
    best = here.closest()
    rise = float(chdtri(1, 1 - level))
    allowed = 2 * best.cost + rise
    centre = float(np.sum(direction * best.x))
    moved = np.sum(direction[:, None] * _root(here.jacobian(best.x)), axis=0)
    spread = float(np.sqrt(np.sum(moved**2)))
    if spread > REACH:
        return -np.inf, np.inf
    if spread == 0:
        return 0.0, 0.0

    def excess(distance: float) -> float:
        found = here.closest((direction, centre + distance, _PULL * spread))
        return float(2 * found.cost - allowed)

    def end(sign: float) -> float:
        # Just beyond where it is if the surrogate is linear.
        far = float(sign * 1.1 * np.sqrt(rise) * spread)
        while excess(far) < 0:
            if abs(far) > REACH:
                return sign * np.inf
            far *= 2
        return float(brentq(excess, 0.0, far, xtol=1e-3 * spread))

    offset = centre - float(np.sum(direction * here.point))
    return offset + end(-1.0), offset + end(1.0)


def _differenced(
    run: Callable[[Array], Array], problem: Problem, point: Array, responses: Array
) -> Surrogate:
    columns = []
    for i in range(len(point)):
        below, above = point[i] - problem.lower[i], problem.upper[i] - point[i]
        # Where bounds leave no room for a whole step, the larger part of it.
        step = min(STEP, above) if above >= min(STEP, below) else -min(STEP, below)
        moved = point.copy()
        moved[i] += step
        columns.append(_change(problem, responses, run(moved)) / step)
    return Surrogate(problem, point, responses, np.stack(columns, axis=1))


def _check_effect(here: Surrogate) -> None:
    n = len(here.problem.observed)
    effects = np.max(np.abs(here.jacobian(here.point)), axis=0)
    size = np.where(here.problem.logged, 1.0, np.abs(here.responses))[:n]
    for name, effect, slopes in zip(here.problem.names, effects, here.slopes[:n].T, strict=True):
        if effect >= NO_EFFECT:
            continue
        if np.any(np.abs(slopes) > NOTABLE * size):
            raise CaseError(
                f"what {name} changes is measured too badly to tell: a change by a factor e comes "
                f"to {effect:.1g} of the uncertainty; is the unit of that the one that was meant?"
            )
        raise CaseError(
            f"{name} changes none of the measured values; leave it out of fit, or measure "
            "something that depends on it"
        )


def _change(problem: Problem, before: Array, after: Array) -> Array:
    """Return the change of the responses, of their logarithms where logged."""
    logged = problem.logged
    ratio = np.where(logged, after, 1.0) / np.where(logged, before, 1.0)
    return np.where(logged, np.log(ratio), after - before)
