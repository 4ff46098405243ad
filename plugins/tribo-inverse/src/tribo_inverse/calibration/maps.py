"""Local wear coefficients from a depth map: the most probable map, and its standard deviation."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from contextlib import closing
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.fft import dctn, idctn
from scipy.optimize import minimize
from scipy.special import chdtrc, ndtri
from tribo import Array, Case, CaseError, Finding, Mask, NumericalError, Simulation
from tribo.kernel_api import Model, begin, march

from tribo_inverse.adjoint.backwards import swept_back
from tribo_inverse.adjoint.unknowns import value_and_gradient
from tribo_inverse.adjoint.view import Seeds, View
from tribo_inverse.calibration.cells import cell_means
from tribo_inverse.calibration.lanczos import eigenpairs
from tribo_inverse.calibration.linearised import Weights
from tribo_inverse.calibration.prior import Prior
from tribo_inverse.calibration.quantities import EDGE_CELL_SIGMA, edge_sigma
from tribo_inverse.findings import UNLIKELY, of_map
from tribo_inverse.recording.local import factor_shape, localised
from tribo_inverse.recording.tape import Tape, recorded

FURTHEST = 30.0
"""Largest logarithm of a factor that is evaluated."""
STEP = 1e-2
"""Largest change of a logarithm for the finite difference of all depths along a direction."""
FIRST_ITERATIONS = 10
"""Steps of L-BFGS before the information is computed."""
ITERATIONS = 100
"""Largest number of steps after it."""
FALL = 0.05
"""Fall of −ln p that ends the steps where −ln p is half of the number of cells, as expected: errors
of runs hide it."""
SILENT = 0.9
"""Posterior standard deviation over the prior's, above which the data give no information."""


@dataclass(frozen=True, eq=False)
class FittedMap:
    """The factor on a body's wear coefficient at each cell of its surface, shape (rows, ny)."""

    body: str
    """Name of the body."""
    logs: Array
    """Most probable ln(k/k₀)."""
    deviation: Array
    """Its standard deviation."""
    prior: float
    """Standard deviation of the prior."""
    spacing: tuple[float, float]
    """Edge lengths of a cell, in m."""
    measured: Array
    """Measured depth, in m; NaN where missing."""
    computed: Array
    """Depth of the fit, in m."""
    uncertainty: Array
    """Standard deviation of their difference, in m."""
    gradients: int
    """Number of gradients."""
    products: int
    """Number of products with the Fisher information."""
    chi_square: float
    degrees_of_freedom: float
    """Measured cells, less Σ λ/(1 + λ) over the eigenvalues λ of the information, and less one for
    each unknown coordinate of the position of the map."""
    findings: tuple[Finding, ...] = ()
    """Findings on the map and the fit."""

    @property
    def factor(self) -> Array:
        """Median of k/k₀."""
        return np.exp(self.logs)

    @property
    def told(self) -> Mask:
        """Where the data narrow the prior."""
        return np.asarray(self.deviation < SILENT * self.prior)

    def interval(self, level: float) -> tuple[Array, Array]:
        """Return the ends of the interval of the factor at each cell."""
        far = float(ndtri(0.5 + 0.5 * level)) * self.deviation
        return np.exp(self.logs - far), np.exp(self.logs + far)

    @property
    def p_value(self) -> float:
        """Probability of a χ² at least as large by chance."""
        return float(chdtrc(self.degrees_of_freedom, self.chi_square))

    @property
    def is_refuted(self) -> bool:
        """Whether no map that varies so smoothly explains the depths."""
        return self.degrees_of_freedom > 1 and self.p_value < UNLIKELY

    @property
    def notes(self) -> list[str]:
        """The findings in words."""
        return [each.words for each in self.findings]


def fit_map(
    case: Case | Mapping[str, Any] | str | Path | Model,
    body: str,
    depth: Array,
    sigma: Array | float,
    prior: Prior,
    *,
    placed: tuple[float, float] = (0.0, 0.0),
    products: int = 60,
    on_run: Callable[[int, float], None] = lambda count, misfit: None,
) -> FittedMap:
    """Fit local factors on the wear coefficient of a body to a map of its depth.

    The maximum of the posterior is found by L-BFGS with exact gradients, in cosine modes of the
    prior. The posterior's standard deviation is linearised: the Fisher information Jᵀ V⁻¹ J is
    projected on a Krylov space (Bui-Thanh et al. 2013, SIAM J. Sci. Comput. 35, A2494-A2523) by at
    most `products` products, each a run and an adjoint pass. Directions beyond keep the prior's
    standard deviation, which is too large rather than too small. The information also
    preconditions L-BFGS.

    `depth` is the mean depth of each cell at the end, in m, of the shape of `View.wear`, NaN where
    missing, and `sigma` its standard deviation, to which `edge_sigma` is added. `placed` has the
    standard deviations of the map's position along and across the sliding direction, in m.
    `on_run` is called after each gradient or product with their number and χ², NaN for a product.
    """
    misfits: list[float] = []

    def tell(misfit: float) -> None:
        misfits.append(misfit)
        on_run(len(misfits), misfit)

    posterior = _Posterior(Simulation(case).model, body, depth, sigma, prior, tell, placed)
    z, basis, values = posterior.fitted(products)
    logs = posterior.logs(z)
    fit = posterior.run(logs)
    reduction = sum(
        value / (1 + value) * posterior.logs(vector) ** 2
        for vector, value in zip(basis, values, strict=True)
    )
    weights, made = posterior.weights, int(np.sum(np.isnan(misfits)))
    freedom = np.sum(~np.isnan(depth)) - np.sum(values / (1 + values)) - weights.vectors.shape[1]
    found = FittedMap(
        body=body,
        logs=logs.reshape(depth.shape),
        deviation=np.sqrt(np.maximum(prior.spread**2 - reduction, 0.0)).reshape(depth.shape),
        prior=prior.spread,
        spacing=posterior.model.grid.spacing,
        measured=depth,
        computed=cell_means(fit.wear(body)),
        uncertainty=weights.sigma.reshape(depth.shape),
        gradients=len(misfits) - made,
        products=made,
        chi_square=2 * posterior.misfit(fit)[0],
        degrees_of_freedom=float(freedom),
    )
    return replace(found, findings=tuple(of_map(found)))


class _Posterior:
    """The posterior of a map, in cosine modes whose prior amplitudes are independent N(0, 1)."""

    def __init__(
        self,
        model: Model,
        body: str,
        depth: Array,
        sigma: Array | float,
        prior: Prior,
        tell: Callable[[float], None],
        placed: tuple[float, float],
    ) -> None:
        self.model, self.body, self.depth, self.sigma = model, body, depth, sigma
        self.tell, self.placed = tell, placed
        if depth.shape != (shape := factor_shape(model, body)):
            raise CaseError(
                f"the depth map of {body} has the shape {depth.shape}, its surface {shape}"
            )
        self.amplitudes = prior.amplitudes(shape, model.grid.spacing)
        self.scale = prior.scale(self.amplitudes)
        self.weights = Weights.of(np.ones(depth.size))
        self.gradient = value_and_gradient(model, self.misfit, (), [body])

    def fitted(self, products: int) -> tuple[Array, Array, Array]:
        """Return the most probable amplitudes, and the eigenpairs of the information."""
        near, none = np.zeros(self.depth.size), np.zeros((0, self.depth.size))
        self.weigh(near)
        near = self.least(near, none, none[:, 0], FIRST_ITERATIONS)
        self.weigh(near)
        basis, values = self.information(near, products)
        return self.least(near, basis, values, ITERATIONS), basis, values

    def least(self, near: Array, basis: Array, values: Array, steps: int) -> Array:
        """Return the most probable amplitudes, or the amplitudes after `steps`, by L-BFGS.

        The eigenpairs of the information, which are known nearby, precondition the steps.
        """
        less = (1 + values) ** -0.5 - 1

        def preconditioned(y: Array) -> Array:
            along = less * np.sum(basis * y, axis=1)
            return np.asarray(y + np.sum(along[:, None] * basis, axis=0))

        def posterior(y: Array) -> tuple[float, Array]:
            z = near + preconditioned(y)
            logs = self.logs(z)
            if (most := float(np.max(np.abs(logs)))) > FURTHEST:
                raise NumericalError(f"a step went {most:.3g} away in the logarithm of a factor")
            value, slope = self.gradient(logs)
            self.tell(2 * value)
            return value + 0.5 * float(np.sum(z * z)), preconditioned(self.adjoint(slope) + z)

        options = {"maxiter": steps, "ftol": 2 * FALL / near.size}
        found = minimize(posterior, 0 * near, jac=True, method="L-BFGS-B", options=options)
        return np.asarray(near + preconditioned(found.x))

    def logs(self, z: Array) -> Array:
        """Return ln(k/k₀) of amplitudes."""
        waves = self.amplitudes * z.reshape(self.depth.shape)
        return np.asarray((self.scale * idctn(waves, norm="ortho")).ravel())

    def adjoint(self, slope: Array) -> Array:
        """Return derivatives by the amplitudes from derivatives by ln(k/k₀): adjoint of `logs`."""
        waves = dctn(self.scale * slope.reshape(self.depth.shape), norm="ortho")
        return np.asarray((self.amplitudes * waves).ravel())

    def weigh(self, z: Array) -> None:
        """Set the weights of the map, with edges and slopes of the scar of these amplitudes."""
        worn, spacing = self.run(self.logs(z)).wear(self.body), self.model.grid.spacing
        total = np.hypot(self.sigma, edge_sigma(worn, EDGE_CELL_SIGMA))
        axes = [axis for axis in (0, 1) if self.placed[axis] and worn.shape[axis] > 1]
        mean = cell_means(worn)
        moves = [self.placed[axis] * np.gradient(mean, spacing[axis], axis=axis) for axis in axes]
        columns = np.array([np.where(np.isnan(self.depth), 0.0, each).ravel() for each in moves])
        self.weights = Weights.of(total.ravel(), columns.reshape(-1, self.depth.size).T)

    def misfit(self, view: View) -> tuple[float, Seeds]:
        """Return half of the weighed sum of the squared residuals, and its derivative."""
        residuals = np.nan_to_num(cell_means(view.wear(self.body)) - self.depth)
        value = 0.5 * float(np.sum(self.weights.weigh(residuals.ravel()) ** 2))
        return value, self.seeds(residuals)

    def seeds(self, residuals: Array) -> Seeds:
        """Return the derivative of half the weighed sum of squares of residuals, in m."""
        weighed = self.weights.weigh_transposed(self.weights.weigh(residuals.ravel()))
        # `cell_means` is its own adjoint.
        return Seeds({self.body: cell_means(weighed.reshape(residuals.shape))})

    def local(self, logs: Array) -> Model:
        """Return the model with local factors, given as ln(k/k₀)."""
        return localised(self.model, self.gradient.at(logs)[1])

    def run(self, logs: Array) -> View:
        """Return the end of a run with local factors, given as ln(k/k₀)."""
        model = self.local(logs)
        *_, last = march(model, begin(model))
        return View(model, last.state)

    def information(self, z: Array, products: int) -> tuple[Array, Array]:
        """Return eigenvectors, as rows, and eigenvalues of Jᵀ V⁻¹ J about amplitudes."""
        logs = self.logs(z)
        model, time = self.local(logs), self.model.end_time
        with closing(Tape(model)) as tape:
            end = View(model, recorded(model, [time], tape)[time]).wear(self.body)

            def product(vector: Array) -> Array:
                move = self.logs(vector)
                step = STEP / np.max(np.abs(move))
                change = cell_means(self.run(logs + step * move).wear(self.body) - end) / step
                seeds = self.seeds(np.where(np.isnan(self.depth), 0.0, change))
                found = swept_back(model, tape, {time: seeds}, [])
                self.tell(math.nan)
                return self.adjoint(found.maps["wear_rate"][self.body].ravel())

            return eigenpairs(product, self.depth.size, products)
