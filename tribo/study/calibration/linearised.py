"""A model near a run, and how well it meets what was measured."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import least_squares, minimize_scalar
from scipy.special import log_ndtr
from scipy.stats import multivariate_normal

from tribo.core.arrays import Array, Mask

LEAP, STRIDE = np.log(100.0), np.log(4.0)
"""How far a parameter may move between two runs; the second where depths are taken as linear."""
REPEATABILITIES = (1e-3, 3.0)
"""Least and largest that is estimated."""
FAINT = 0.1
"""Change of the data, in standard deviations, per change by e, that tells as good as nothing."""
_PASSES, _SAME, _RIDGE = 30, 1e-5, 1e-12
_UNKNOWN = 10.0
"""Standard deviation of a logarithm from which a parameter is not determined."""


@dataclass(frozen=True)
class Weights:
    """The symmetric root of the inverse covariance of data in their standard deviations.

    The covariance is 1 + B Bᵀ with B what is off together, shape (n, k); the root of its inverse
    is 1 − U c Uᵀ with the singular vectors U of B.
    """

    sigma: Array
    """Standard deviations of the data alone, shape (n,)."""
    along: Array
    less: Array
    """The vectors U, shape (n, k), and c, shape (k,)."""

    @classmethod
    def of(cls, sigma: Array, together: Array | None = None) -> Weights:
        """Return the weights of data, of which so much, shape (n, k), is off together."""
        if together is None:
            return cls(sigma, np.zeros((len(sigma), 0)), np.zeros(0))
        along, sizes, _ = np.linalg.svd(together / sigma[:, None], full_matrices=False)
        return cls(sigma, along, 1 - (1 + sizes**2) ** -0.5)

    def weigh(self, values: Array) -> Array:
        """Return values in standard deviations, made independent; shape (n,) or (n, m)."""
        return self._root((values.T / self.sigma).T)

    def back(self, values: Array) -> Array:
        """Return the product of the transposed weights with values, of the same shape."""
        return (self._root(values).T / self.sigma).T

    def _root(self, values: Array) -> Array:
        common = self.less * (self.along.T @ values).T
        return np.asarray(values - self.along @ common.T)

    def alone(self, rows: Mask) -> Array:
        """Return the weights of data that share nothing with others."""
        return np.asarray((1 - self.along[rows] ** 2 @ self.less) / self.sigma[rows])

    def log_determinant(self, rows: Mask) -> float:
        """Return the logarithm of the determinant for data that share nothing with the others."""
        inside = self.along[rows].T @ self.along[rows]
        size = np.linalg.slogdet(np.eye(len(inside)) - self.less[:, None] * inside)[1]
        return float(size - np.sum(np.log(self.sigma[rows])))


@dataclass(frozen=True)
class Problem:
    """What is fitted: p parameters, to n data, which the first n of m responses answer to."""

    names: tuple[str, ...]
    observed: Array
    sigma: Array
    """Measured values and their standard deviations, shape (n,)."""
    below: Mask
    specimen: Array
    """Where the value is a limit of detection, and of which test it is, shape (n,)."""
    repeatability: float | None
    """Relative standard deviation of the parameters from test to test; None to estimate it."""
    small: Array
    """Of a depth that may be 0 how much is no more near to a power law of the parameters, shape
    (m,); 0 for what is positive."""
    lower: Array
    upper: Array
    """Bounds of the logarithms of the parameters, shape (p,); infinite for none."""
    common: Array
    """What errors of one standard deviation, of one source each, add to all data, shape (n, k)."""

    def weights(self, scatter: Array | None = None) -> Weights:
        """Return the weights of the data, of which so much more, shape (n, j), is off together."""
        parts = [self.common] if scatter is None else [self.common, scatter]
        return Weights.of(self.sigma, np.concatenate(parts, axis=1))

    def without_common(self) -> Problem:
        """Return the problem with errors that each datum has alone."""
        return replace(self, common=self.common[:, :0])

    def scaled(self, responses: Array) -> Array:
        """Return responses in whose terms slopes change little: logarithms, linear near 0.

        A prediction may be 0, and remains so.
        """
        found = np.log(responses, out=responses.copy(), where=responses > 0)
        depth = self.small > 0
        found[depth] = np.arcsinh(responses[depth] / self.small[depth])
        return found

    def residuals(self, responses: Array, weights: Weights) -> Array:
        """Return residuals, in standard deviations; their squares are −2 ln of the likelihood.

        That of a limit of detection is √(−2 ln Φ(z)), z being how far below it the value lies.
        """
        found = weights.weigh(responses[: len(self.observed)] - self.observed)
        found[self.below] = np.sqrt(-2 * log_ndtr(-found[self.below]))
        return found

    def together(self, effects: Array) -> Array:
        """Return the effects of the parameters of each test alone, shape (n, tests · p).

        All that was measured in a test is off together; a limit of detection is a test of its own.
        """
        test = np.where(self.below, -1 - np.arange(len(self.below)), self.specimen)
        own = test[:, None] == np.unique(test)
        return np.asarray((own[:, :, None] * effects[:, None, :]).reshape(len(effects), -1))


@dataclass(frozen=True)
class Linearised:
    """The model near a run: power laws, of depths that may be 0 linear in the logarithms."""

    problem: Problem
    point: Array
    responses: Array
    """Logarithms of the parameters of the run, shape (p,), and what it gave, shape (m,)."""
    slopes: Array
    """Derivatives of `Problem.scaled` by the logarithms of the parameters, shape (m, p)."""
    weights: Weights
    repeatability: float = 0.0
    """Part of the weights: relative standard deviation from test to test."""

    def at(self, point: Array) -> Array:
        """Return the responses at another point."""
        change = np.sum(self.slopes * (point - self.point), axis=1)
        moved, power = self.responses + self._steepness * change, self.problem.small == 0
        moved[power] = np.exp((self.problem.scaled(self.responses) + change)[power])
        return np.asarray(moved)

    @property
    def _steepness(self) -> Array:
        """Derivatives of the responses by `Problem.scaled`, shape (m,)."""
        return np.asarray(np.hypot(self.responses, self.problem.small))

    def effects(self, point: Array) -> Array:
        """Return the derivatives of the data by the logarithms of the parameters, shape (n, p)."""
        n = len(self.problem.observed)
        # A depth's are the same everywhere, as those by which tests are taken to scatter.
        factor = np.where(self.problem.small > 0, self._steepness, self.at(point))[:n]
        return np.asarray(factor[:, None] * self.slopes[:n])

    def residuals(self, point: Array) -> Array:
        """Return the misfit of the data; see `Problem.residuals`."""
        return self.problem.residuals(self.at(point), self.weights)

    def jacobian(self, point: Array) -> Array:
        """Return the derivatives of `residuals`, shape (n, p)."""
        found = self.weights.weigh(self.effects(point))
        below = self.problem.below
        # d/dz of √(−2 ln Φ(z)) is −φ/(Φ √(−2 ln Φ)).
        root = self.residuals(point)[below]
        above = (self.at(point)[: len(below)] - self.problem.observed)[below]
        above = above * self.weights.alone(below)
        inside = np.exp(-0.5 * above**2 + 0.5 * root**2) / np.sqrt(2 * np.pi)
        slope = np.divide(inside, root, out=np.zeros_like(root), where=root > 0)
        found[below] *= slope[:, None]
        return found

    def sensitivity(self) -> Array:
        """Return the derivatives of the data in standard deviations, shape (n, p).

        Those of a limit of detection are of a value that just meets it.
        """
        effects, observed = self.effects(self.point), self.problem.observed
        below = self.problem.below
        met = observed[below] / self.responses[: len(below)][below]
        effects[below] *= np.maximum(met, 1.0)[:, None]
        return self.weights.weigh(effects)

    def limited(self) -> Mask:
        """Return of which parameters nothing but limits of detection tells, shape (p,)."""
        found, below = self.sensitivity(), self.problem.below
        told = np.sqrt(np.sum(found[~below] ** 2, axis=0))
        return np.asarray((told < FAINT) & np.any(np.abs(found[below]) > FAINT, axis=0))

    def bounds(self, reach: float) -> tuple[Array, Array]:
        """Return the bounds of a point no farther than `reach` from that of the run."""
        lower = np.maximum(self.problem.lower, self.point - reach)
        return lower, np.minimum(self.problem.upper, self.point + reach)

    def least(self, start: Array, rows: Mask | slice = slice(None)) -> Array:
        """Return the least-squares point of rows of the data within the bounds and a leap."""
        fields = np.any(self.problem.small > 0)
        ends = self.bounds(STRIDE if fields else LEAP)
        found = least_squares(
            lambda point: self.residuals(point)[rows],
            np.clip(start, *ends),
            lambda point: self.jacobian(point)[rows],
            ends,
            xtol=1e-10,
            ftol=1e-10,
            gtol=1e-10,
        )
        return np.asarray(found.x)

    def best(self) -> tuple[Linearised, Array]:
        """Return the model with the data weighed as at its least-squares point, and that point."""
        here, point = self, self.least(self.point)
        if self.problem.repeatability == 0:
            return here, point
        for _ in range(_PASSES):
            given = self.problem.repeatability
            here = here.weighed(point, here._estimated(point) if given is None else given)
            former, point = point, here.least(point)
            if np.max(np.abs(point - former)) < _SAME:
                break
        return here, point

    def weighed(self, point: Array, repeatability: float) -> Linearised:
        """Return the model with data that repeat so well weighed as at a point."""
        scatter = None
        if repeatability > 0:
            scatter = repeatability * self.problem.together(self.effects(point))
        weights = self.problem.weights(scatter)
        return replace(self, weights=weights, repeatability=repeatability)

    def freedom(self, direction: Array) -> float:
        """Return the degrees of freedom with which the variance of direction · point is known.

        2 g²/Var(g) with the variance g (Satterthwaite 1946, Biometrics Bulletin 2, 110-114);
        infinite if the repeatability is stated.
        """
        if self.problem.repeatability is not None:
            return np.inf
        jacobian = self.sensitivity()
        together = self.weights.weigh(self.problem.together(self.effects(self.point)))
        directions = np.linalg.svd(jacobian, full_matrices=False)[0]
        left = together - directions @ (directions.T @ together)
        root = root_covariance(jacobian)
        effect = np.sum(jacobian * np.sum(root * (direction @ root), axis=1), axis=1)
        slope = np.sum((effect @ together) ** 2)
        variance = np.sum((direction @ root) ** 2)
        known = np.sum((left.T @ left) ** 2)
        return float(variance**2 * known / slope**2) if slope > 0 else np.inf

    def deviance(self, point: Array) -> float:
        """Return twice the negative logarithm of the likelihood at a point."""
        values = ~self.problem.below
        scale = np.sum(values) * np.log(2 * np.pi) - 2 * self.weights.log_determinant(values)
        return float(np.sum(self.residuals(point) ** 2) + scale)

    def left_out(self) -> Array:
        """Return the log-likelihood of each test foretold from all others, shape (tests,).

        NaN if those do not determine a parameter; none of a single test.
        """
        found, below, n = [], self.problem.below, len(self.problem.observed)
        tests = np.unique(self.problem.specimen)
        for test in tests if len(tests) > 1 else []:
            own = self.problem.specimen == test
            point = self.least(self.point, ~own)
            rest = replace(self, point=point, responses=self.at(point))
            root = root_covariance(rest.sensitivity()[~own])
            # How far the estimate puts each value off, beside its own scatter.
            apart = self.weights.weigh(rest.effects(point)) @ root
            off = self.weights.weigh(rest.responses[:n] - self.problem.observed)
            values, limits = own & ~below, own & below
            broader = np.sqrt(1 + np.sum(apart[limits] ** 2, axis=1))
            likelihood = np.sum(log_ndtr(-off[limits] / broader))
            if np.any(values):
                covariance = np.eye(np.sum(values)) + apart[values] @ apart[values].T
                likelihood += multivariate_normal.logpdf(off[values], cov=covariance)
                likelihood += self.weights.log_determinant(values)
            known = np.max(np.sum(root**2, axis=1)) < _UNKNOWN**2
            found.append(likelihood if known else np.nan)
        return np.array(found)

    def _estimated(self, point: Array) -> float:
        """Return the repeatability by restricted maximum likelihood about a point."""
        bounds = self.problem.lower, self.problem.upper
        free = np.all([np.abs(point - bound) > _SAME for bound in bounds], axis=0)

        def criterion(repeatability: float) -> float:
            here = self.weighed(point, repeatability)
            left, sizes, _ = np.linalg.svd(here.jacobian(point)[:, free], full_matrices=False)
            # What a step of Gauss and Newton takes off the misfit.
            taken = np.sum(left * here.residuals(point)[:, None], axis=0)
            lost = 2 * np.sum(np.log(sizes + _RIDGE))
            return float(here.deviance(point) - np.sum(taken**2) + lost)

        found = minimize_scalar(
            lambda log: criterion(np.exp(log)),
            bounds=np.log(REPEATABILITIES),
            method="bounded",
            options={"xatol": 1e-4},
        )
        return float(np.exp(found.x)) if found.fun < criterion(0.0) else 0.0


def root_covariance(jacobian: Array) -> Array:
    """Return a root B of the covariance (JᵀJ)⁻¹ = B Bᵀ, shape (p, p); finite in any case."""
    size = np.sqrt(np.sum(jacobian**2, axis=0)) + _RIDGE
    _, values, directions = np.linalg.svd(jacobian / size, full_matrices=False)
    return np.asarray(directions.T / np.sqrt(values**2 + _RIDGE) / size[:, None])
