"""Least squares in few runs: a surrogate of the model, fitted by SciPy, and its intervals."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import LinearConstraint, NonlinearConstraint, least_squares, minimize
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
SETTLED, HARDLY = 0.01, 0.1
"""Change of the data, in standard deviations, that ends the fit; the second if χ² stays the same.

The first is also the part of χ² that counts as a fall.
"""
NO_EFFECT = 1e-3
"""Change of a datum, in standard deviations, per change of a parameter by e: nothing to learn."""
NOTABLE = 0.01
"""Relative change of a datum, per change of a parameter by e, that is above rounding."""
MOST_ROUNDS, MOST_IN_VAIN = 12, 4
"""Rounds, and rounds without a lower misfit, after which a fit is given up."""
_RIDGE = 1e-12


@dataclass(frozen=True)
class Problem:
    """What is fitted.

    Parameters
    ----------
    names : tuple of str
        What the parameters are called in messages.
    observed, sigma : ndarray, shape (n,)
        Measured values and their standard deviations.
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

    def scaled(self, responses: Array) -> Array:
        """Return responses, of those that are `logged` the logarithms."""
        return np.log(responses, out=responses.copy(), where=self.logged)


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
        moved = self.problem.scaled(self.responses)
        moved += np.sum(self.slopes * (point - self.point), axis=1)
        return np.exp(moved, out=moved, where=self.problem.logged)

    def residuals(self, point: Array) -> Array:
        """Return the misfit of the data, in standard deviations."""
        return self.problem.residuals(self.at(point))

    def jacobian(self, point: Array) -> Array:
        """Return the derivatives of `residuals`, shape (n, p)."""
        n = len(self.problem.observed)
        factor = np.where(self.problem.logged, self.at(point), 1.0)[:n] / self.problem.sigma
        return np.asarray(factor[:, None] * self.slopes[:n])

    def bounds(self, reach: float) -> tuple[Array, Array]:
        """Return the bounds of a point no farther than `reach` from that of the run."""
        lower = np.maximum(self.problem.lower, self.point - reach)
        return lower, np.minimum(self.problem.upper, self.point + reach)

    def best(self) -> Array:
        """Return the least-squares point within the bounds and a leap."""
        tight = {"xtol": 1e-10, "ftol": 1e-10, "gtol": 1e-10}
        ends = self.bounds(LEAP)
        start = np.clip(self.point, *ends)
        found = least_squares(self.residuals, start, self.jacobian, ends, **tight)
        return np.asarray(found.x)

    def updated(self, point: Array, responses: Array) -> Surrogate:
        """Return the surrogate about a new run, its slopes corrected by Broyden's formula."""
        step = point - self.point
        error = self.problem.scaled(responses) - self.problem.scaled(self.at(point))
        slopes = self.slopes + error[:, None] * step / np.sum(step**2)
        return replace(self, point=point, responses=responses, slopes=slopes)


def fit(model: Callable[[Array], Array], problem: Problem, start: Array) -> Surrogate:
    """Fit the parameters by Gauss-Newton on a surrogate, with one run of the model per round.

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
    known = np.log(start)
    here = _differenced(model, problem, known, model(np.exp(known)))
    _check_effect(here)
    least, in_vain = np.inf, 0
    for rounds in range(1, MOST_ROUNDS + 1):  # noqa: B007
        point = here.best()
        shift = np.max(np.abs(here.residuals(point) - here.residuals(here.point)))
        if shift > SETTLED:
            here = here.updated(point, model(np.exp(point)))
            misfit = float(np.sum(here.residuals(point) ** 2))
            in_vain = 0 if misfit < (1 - SETTLED) * least else in_vain + 1
            least = min(least, misfit)
            if in_vain == MOST_IN_VAIN:
                if shift > HARDLY:
                    break
                return here
        elif np.max(np.abs(here.point - known)) > FAR:
            known = here.point
            here = _differenced(model, problem, known, here.responses)
        else:
            return here
    raise NumericalError(
        f"the estimates have not settled after {rounds} rounds: χ² has come down to {least:.3g}, "
        f"and a computed value still changes by {shift:.2g} of its uncertainty; refine "
        "grid.cells, start nearer, or state the uncertainties larger"
    )


def root_covariance(jacobian: Array) -> Array:
    """Return a root B of the covariance (JᵀJ)⁻¹ = B Bᵀ, shape (p, p).

    Where the data tell nothing it is very large, but finite.
    """
    size = np.sqrt(np.sum(jacobian**2, axis=0))
    _, values, directions = np.linalg.svd(jacobian / size, full_matrices=False)
    return np.asarray(directions.T / np.sqrt(values**2 + _RIDGE) / size[:, None])


def interval(here: Surrogate, direction: Array, level: float) -> tuple[float, float]:
    """Return the interval of direction · point, relative to its value at the surrogate's run.

    By the profile likelihood: the least and the largest value at the points
    whose χ² is at most its minimum plus the quantile of χ²₁. It does not
    depend on how the parameters are scaled and keeps within the bounds;
    infinite where the data leave it open.

    Parameters
    ----------
    here : Surrogate
        About the estimate.
    direction : ndarray, shape (p,)
        A unit vector for a parameter, or the slopes of a response.
    level : float
        Probability with which it covers the truth.
    """
    best = here.best()
    rise = float(chdtri(1, 1 - level))
    least = float(np.sum(here.residuals(best) ** 2))
    root = root_covariance(here.jacobian(best))
    # With point = best + root z, χ² rises to first order by |z|².
    gradient = np.sum(direction[:, None] * root, axis=0)
    spread = float(np.sqrt(np.sum(gradient**2)))
    if spread > REACH:
        return -np.inf, np.inf
    if spread == 0:
        return 0.0, 0.0
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
        far = -float(found.fun) * spread
        return sign * (np.inf if far > REACH else far)

    offset = float(np.sum(direction * (best - here.point)))
    return offset + end(-1.0), offset + end(1.0)


def _differenced(
    model: Callable[[Array], Array], problem: Problem, point: Array, responses: Array
) -> Surrogate:
    columns = []
    for i in range(len(point)):
        below, above = point[i] - problem.lower[i], problem.upper[i] - point[i]
        # If bounds leave no room for a whole step, take the larger part of it.
        step = min(STEP, above) if above >= min(STEP, below) else -min(STEP, below)
        moved = point.copy()
        moved[i] += step
        change = problem.scaled(model(np.exp(moved))) - problem.scaled(responses)
        columns.append(change / step)
    return Surrogate(problem, point, responses, np.stack(columns, axis=1))


def _check_effect(here: Surrogate) -> None:
    effects = np.max(np.abs(here.jacobian(here.point)), axis=0)
    for name, effect in zip(here.problem.names, effects, strict=True):
        if effect < NO_EFFECT:
            raise CaseError(
                f"a change of {name} by a factor e changes the measured values by {effect:.1g} of "
                "their uncertainty; leave it out of fit, measure something that depends on it, or "
                "check the units of the uncertainties"
            )
