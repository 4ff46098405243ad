"""A model linearised about a run, its residuals and its likelihood."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import least_squares, minimize_scalar
from tribo import Array

LONGEST_STEP = np.log(100.0)
"""Largest change of a logarithm between two runs."""
REPEATABILITY_RANGE = (1e-3, 3.0)
"""Smallest and largest repeatability that is estimated."""
COLLINEAR = 0.01
"""Singular value of the Jacobian with normalised columns, 1 if the effects of parameters are
orthogonal, up to which the data do not separate them: steps have no part in that direction."""
_STAY = 0.1
"""Weight of a move in that direction, relative to the effects of the parameters on the data."""
_ITERATIONS, _CONVERGED = 30, 1e-5
"""Most steps of a fit to linearised data, and the change of a logarithm that ends it: five
digits."""
RIDGE = 1e-12
"""Relative size, about rounding, of what keeps a singular information invertible."""


@dataclass(frozen=True)
class Weights:
    """Root W of the inverse covariance of the data, WᵀW = V⁻¹.

    V = S (1 + B Bᵀ) S with the independent standard deviations S and the correlated errors B,
    shape (n, k), in units of S. With the singular vectors U of B, W = (1 − U c Uᵀ) S⁻¹.
    """

    sigma: Array
    """Standard deviations S of the independent errors, shape (n,)."""
    vectors: Array
    """U, shape (n, k)."""
    reduction: Array
    """c, shape (k,)."""

    @classmethod
    def of(cls, sigma: Array, correlated: Array | None = None) -> Weights:
        """Return the weights for independent errors and correlated ones, S B, shape (n, k)."""
        if correlated is None:
            return cls(sigma, np.zeros((len(sigma), 0)), np.zeros(0))
        vectors, sizes, _ = np.linalg.svd(correlated / sigma[:, None], full_matrices=False)
        return cls(sigma, vectors, 1 - (1 + sizes**2) ** -0.5)

    def weigh(self, values: Array) -> Array:
        """Return W times values, of shape (n,) or (n, m)."""
        return self._root((values.T / self.sigma).T)

    def weigh_transposed(self, values: Array) -> Array:
        """Return Wᵀ times values, of the same shape."""
        return (self._root(values).T / self.sigma).T

    def _root(self, values: Array) -> Array:
        common = self.reduction * (self.vectors.T @ values).T
        return np.asarray(values - self.vectors @ common.T)

    @property
    def log_determinant(self) -> float:
        """Logarithm of the determinant of W."""
        return float(np.sum(np.log1p(-self.reduction)) - np.sum(np.log(self.sigma)))


@dataclass(frozen=True)
class Problem:
    """A least-squares problem: p parameters, n data, and m responses, n of them for the data."""

    names: tuple[str, ...]
    """Of the parameters."""
    observed: Array
    """Measured values, shape (n,)."""
    sigma: Array
    """Their standard deviations, shape (n,)."""
    specimen: Array
    """Number of the test of each value, shape (n,)."""
    repeatability: float | None
    """Relative standard deviation of the parameters from test to test; None to estimate it."""
    lower: Array
    """Lower bounds of the logarithms of the parameters, shape (p,); −infinity for none."""
    upper: Array
    """Upper bounds, infinity for none."""

    def scaled(self, responses: Array) -> Array:
        """Return responses on a scale on which slopes change little: logarithms.

        A prediction of 0 stays 0.
        """
        return np.log(responses, out=responses.copy(), where=responses > 0)

    def residuals(self, responses: Array, weights: Weights) -> Array:
        """Return weighted residuals; their sum of squares is −2 ln L but for a constant."""
        return weights.weigh(responses[: len(self.observed)] - self.observed)

    def by_test(self, effects: Array) -> Array:
        """Return the effects of parameters that differ from test to test, shape (n, tests · p)."""
        own = self.specimen[:, None] == np.unique(self.specimen)
        return np.asarray((own[:, :, None] * effects[:, None, :]).reshape(len(effects), -1))


@dataclass(frozen=True)
class Linearised:
    """The model about a run: power laws of the parameters."""

    problem: Problem
    point: Array
    """Logarithms of the parameters of the run, shape (p,)."""
    responses: Array
    """Its responses, shape (m,)."""
    slopes: Array
    """Derivatives of `Problem.scaled` by the logarithms of the parameters, shape (m, p)."""
    weights: Weights
    repeatability: float = 0.0
    """Relative standard deviation from test to test, included in the weights."""

    def at(self, point: Array) -> Array:
        """Return the responses at another point."""
        change = np.sum(self.slopes * (point - self.point), axis=1)
        return np.asarray(self.responses * np.exp(change))

    def effects(self, point: Array) -> Array:
        """Return the derivatives of the data by the logarithms of the parameters, shape (n, p)."""
        n = len(self.problem.observed)
        return np.asarray(self.at(point)[:n, None] * self.slopes[:n])

    def residuals(self, point: Array) -> Array:
        """Return the weighted residuals of the data; see `Problem.residuals`."""
        return self.problem.residuals(self.at(point), self.weights)

    def jacobian(self, point: Array | None = None) -> Array:
        """Return the derivatives of `residuals`, shape (n, p), at the last run if no point."""
        return self.weights.weigh(self.effects(self.point if point is None else point))

    def bounds(self, reach: float) -> tuple[Array, Array]:
        """Return the bounds of points within `reach` of the point of the run."""
        lower = np.maximum(self.problem.lower, self.point - reach)
        return lower, np.minimum(self.problem.upper, self.point + reach)

    def least(self) -> Array:
        """Return the least-squares point of the data, within bounds and a longest step.

        It stays where it is along directions that the data do not determine.
        """
        ends = self.bounds(LONGEST_STEP)
        size, angles, directions = normalised(self.jacobian())
        stay = _STAY * directions[angles <= COLLINEAR] * size
        found = least_squares(
            lambda point: np.append(self.residuals(point), stay @ (point - self.point)),
            np.clip(self.point, *ends),
            lambda point: np.concatenate([self.jacobian(point), stay]),
            ends,
            xtol=1e-10,
            ftol=1e-10,
            gtol=1e-10,
        )
        return np.asarray(found.x)

    def best(self) -> tuple[Linearised, Array]:
        """Return the model with the weights of its least-squares point, and that point."""
        here, point = self, self.least()
        if self.problem.repeatability == 0:
            return here, point
        for _ in range(_ITERATIONS):
            given = self.problem.repeatability
            here = here.weighed(point, here._estimated(point) if given is None else given)
            former, point = point, here.least()
            if np.max(np.abs(point - former)) < _CONVERGED:
                break
        return here, point

    def about(self, point: Array, responses: Array, problem: Problem) -> Linearised:
        """Return the model about another run, with the same slopes."""
        weights = Weights.of(problem.sigma)
        return replace(self, point=point, responses=responses, problem=problem, weights=weights)

    def weighed(self, point: Array, repeatability: float) -> Linearised:
        """Return the model with the weights that follow from a repeatability at a point."""
        scatter = None
        if repeatability > 0:
            scatter = repeatability * self.problem.by_test(self.effects(point))
        weights = Weights.of(self.problem.sigma, scatter)
        return replace(self, weights=weights, repeatability=repeatability)

    def degrees_of_freedom(self, direction: Array) -> float:
        """Return the degrees of freedom of the variance of direction · point.

        Infinite if the repeatability is stated.
        """
        if self.problem.repeatability is not None:
            return np.inf
        jacobian, specimen = self.jacobian(), self.problem.specimen
        tests = [jacobian[specimen == one] for one in np.unique(specimen)]
        root = root_covariance(jacobian)
        information = np.array([own.T @ own for own in tests])
        return float(satterthwaite(information, np.ones(len(tests)), root @ root.T, direction))

    def deviance(self, point: Array) -> float:
        """Return −2 ln L at a point."""
        scale = len(self.problem.observed) * np.log(2 * np.pi) - 2 * self.weights.log_determinant
        return float(np.sum(self.residuals(point) ** 2) + scale)

    def _estimated(self, point: Array) -> float:
        """Return the repeatability by restricted maximum likelihood (REML) about a point."""
        bounds = self.problem.lower, self.problem.upper
        free = np.all([np.abs(point - bound) > _CONVERGED for bound in bounds], axis=0)

        def criterion(repeatability: float) -> float:
            here = self.weighed(point, repeatability)
            left, sizes, _ = np.linalg.svd(here.jacobian(point)[:, free], full_matrices=False)
            # By how much a Gauss-Newton step would lower χ².
            fall = np.sum(np.sum(left * here.residuals(point)[:, None], axis=0) ** 2)
            log_information = 2 * np.sum(np.log(sizes + RIDGE))
            return float(here.deviance(point) - fall + log_information)

        found = minimize_scalar(
            lambda log: criterion(np.exp(log)),
            bounds=np.log(REPEATABILITY_RANGE),
            method="bounded",
            options={"xatol": 1e-4},
        )
        return float(np.exp(found.x)) if found.fun < criterion(0.0) else 0.0


def normalised(jacobian: Array) -> tuple[Array, Array, Array]:
    """Return the norms of columns, and singular values and directions of the scaled columns."""
    size = np.sqrt(np.sum(jacobian**2, axis=0)) + RIDGE
    _, values, directions = np.linalg.svd(jacobian / size, full_matrices=False)
    return size, values, directions


def root_covariance(jacobian: Array) -> Array:
    """Return a root B of the covariance (JᵀJ)⁻¹ = B Bᵀ, shape (p, p); finite for a singular J."""
    size, values, directions = normalised(jacobian)
    return np.asarray(directions.T / np.sqrt(values**2 + RIDGE) / size[:, None])


def satterthwaite(information: Array, counts: Array, covariance: Array, directions: Array) -> Array:
    """Return the degrees of freedom of the variance of each of the directions · point.

    2 g²/Var(g) for a variance g (Satterthwaite 1946, Biometrics Bulletin 2, 110-114), which is
    estimated from the scatter of tests, each with its Fisher information, shape (tests, p, p), and
    made as often as `counts` says.
    """
    twice, thrice = (
        np.sum(counts[:, None, None] * np.linalg.matrix_power(information, power), axis=0)
        for power in (2, 3)
    )
    scattered = twice @ covariance
    left = np.trace(twice) - 2 * np.trace(thrice @ covariance) + np.sum(scattered * scattered.T)
    along = directions @ covariance
    variances = np.sum(along * directions, axis=-1)
    slopes = np.sum((along @ twice) * along, axis=-1)
    freedom = np.full(np.shape(variances), np.inf)
    np.divide(variances**2 * max(left, 0.0), slopes**2, out=freedom, where=slopes > 0)
    return freedom
