"""Local wear coefficients from depth maps: the most probable map, and its standard deviation."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.fft import dctn, idctn
from scipy.special import chdtrc, ndtri
from tribo import Array, Case, CaseError, Finding, Mask, NumericalError, Simulation
from tribo.kernel_api import Model, begin, march

from tribo_inverse.adjoint.backwards import swept_back
from tribo_inverse.adjoint.unknowns import FURTHEST, ValueAndGradient
from tribo_inverse.adjoint.view import Seeds, View
from tribo_inverse.calibration.cells import cell_means
from tribo_inverse.calibration.descent import descended
from tribo_inverse.calibration.lanczos import eigenpairs
from tribo_inverse.calibration.linearised import Weights
from tribo_inverse.calibration.prior import Prior
from tribo_inverse.calibration.quantities import EDGE_CELL_SIGMA, edge_sigma
from tribo_inverse.findings import UNLIKELY, of_maps
from tribo_inverse.recording.local import factor_shape, localised
from tribo_inverse.recording.tape import Tape, recorded

STEP = 1e-2
"""Largest change of a logarithm for the finite difference of all depths along a direction."""
FIRST_ITERATIONS = 10
"""Steps of L-BFGS before the information is computed."""
ITERATIONS = 100
"""Largest number of steps after it."""
SILENT = 0.9
"""Posterior standard deviation over the prior's, above which the data give no information."""


@dataclass(frozen=True, eq=False)
class LocalMap:
    """The factor on a body's wear coefficient at each cell of its surface, shape (rows, ny)."""

    logs: Array
    """Most probable ln(k/k₀)."""
    deviation: Array
    """Its standard deviation."""
    prior: Array
    """Standard deviation of the prior."""
    spacing: tuple[float, float]
    """Edge lengths of a cell, in m."""
    measured: Array
    """Measured depth, in m; NaN where missing."""
    computed: Array
    """Depth of the fit, in m."""
    uncertainty: Array
    """Standard deviation of their difference, in m."""

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


@dataclass(frozen=True, eq=False)
class FittedMaps:
    """Local coefficients fitted to depth maps."""

    maps: Mapping[str, LocalMap]
    """By the name of the body."""
    gradients: int
    """Number of gradients."""
    products: int
    """Number of products with the Fisher information."""
    chi_square: float
    degrees_of_freedom: float
    """Measured cells, less Σ λ/(1 + λ) over the eigenvalues λ of the information, and less one for
    each unknown coordinate of the position of a map."""
    findings: tuple[Finding, ...] = ()
    """Findings on the maps and the fit."""

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


def fit_maps(
    case: Case | Mapping[str, Any] | str | Path | Model,
    depths: Mapping[str, tuple[Array, Array | float]],
    priors: Mapping[str, Prior],
    *,
    placed: Mapping[str, Sequence[float]] | None = None,
    products: int = 60,
    on_run: Callable[[int, float], None] = lambda count, misfit: None,
) -> FittedMaps:
    """Fit local factors on the wear coefficients of bodies to maps of their depth.

    The maximum of the posterior is found by L-BFGS with exact gradients, in cosine modes of the
    prior. The posterior's standard deviation is linearised: the Fisher information Jᵀ V⁻¹ J is
    projected on a Krylov space (Bui-Thanh et al. 2013, SIAM J. Sci. Comput. 35, A2494-A2523) by at
    most `products` products, each a run and an adjoint pass. Directions beyond keep the prior's
    standard deviation, which is too large rather than too small. The information also
    preconditions L-BFGS.

    `depths` has, by the name of the body, the mean depth of each cell at the end, in m, of the
    shape of `View.wear`, NaN where missing, and their standard deviations, to which `edge_sigma`
    is added. `placed` has the standard deviations of a map's position along and across the sliding
    direction, in m, by body; 0 by default. `on_run` is called after each gradient or product with
    their number and χ², NaN for a product.
    """
    misfits: list[float] = []

    def tell(misfit: float) -> None:
        misfits.append(misfit)
        on_run(len(misfits), misfit)

    posterior = _Posterior(Simulation(case).model, depths, priors, tell, placed or {})
    z, basis, values = posterior.fitted(products)
    logs = posterior.logs(z)
    fit = posterior.run(logs)
    reduction = sum(
        value / (1 + value) * posterior.logs(vector) ** 2
        for vector, value in zip(basis, values, strict=True)
    )
    maps = {}
    for name, part in posterior.parts.items():
        shape, prior = posterior.shapes[name], np.full(posterior.shapes[name], priors[name].spread)
        variance = prior**2 - reduction[part].reshape(shape)
        maps[name] = LocalMap(
            logs[part].reshape(shape),
            np.sqrt(np.maximum(variance, 0.0)),
            prior,
            posterior.model.grid.spacing,
            depths[name][0],
            cell_means(fit.wear(name)),
            posterior.weights[name].sigma.reshape(shape),
        )
    read = sum(int(np.sum(~np.isnan(depth))) for depth, _ in depths.values())
    of_places = sum(weights.vectors.shape[1] for weights in posterior.weights.values())
    made = int(np.sum(np.isnan(misfits)))
    found = FittedMaps(
        maps=maps,
        gradients=len(misfits) - made,
        products=made,
        chi_square=2 * posterior.misfit(fit)[0],
        degrees_of_freedom=read - float(np.sum(values / (1 + values))) - of_places,
    )
    return replace(found, findings=tuple(of_maps(found)))


class _Posterior:
    """The posterior of maps, in cosine modes whose prior amplitudes are independent N(0, 1)."""

    def __init__(
        self,
        model: Model,
        depths: Mapping[str, tuple[Array, Array | float]],
        priors: Mapping[str, Prior],
        tell: Callable[[float], None],
        placed: Mapping[str, Sequence[float]],
    ) -> None:
        self.model, self.depths, self.priors, self.tell = model, depths, priors, tell
        self.placed = placed
        self.shapes = {name: factor_shape(model, name) for name in depths}
        self.amplitudes, self.scales, self.parts, self.size = {}, {}, {}, 0
        for name, shape in self.shapes.items():
            if depths[name][0].shape != shape:
                raise CaseError(
                    f"the depth map of {name} has the shape {depths[name][0].shape}, its surface "
                    f"{shape}"
                )
            self.amplitudes[name] = priors[name].amplitudes(shape, model.grid.spacing)
            self.scales[name] = priors[name].scale(self.amplitudes[name])
            self.parts[name] = slice(self.size, self.size + shape[0] * shape[1])
            self.size = self.parts[name].stop
        self.weights: dict[str, Weights] = {}
        self.gradient = ValueAndGradient(model, self.misfit, (), list(depths))

    def fitted(self, products: int) -> tuple[Array, Array, Array]:
        """Return the most probable amplitudes, and the eigenpairs of the information."""
        near, none = np.zeros(self.size), np.zeros((0, self.size))
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

        return np.asarray(near + preconditioned(descended(posterior, 0 * near, steps)))

    def logs(self, z: Array) -> Array:
        """Return ln(k/k₀) of amplitudes."""
        found = np.empty(self.size)
        for name, part in self.parts.items():
            waves = self.amplitudes[name] * z[part].reshape(self.shapes[name])
            found[part] = (self.scales[name] * idctn(waves, norm="ortho")).ravel()
        return found

    def adjoint(self, slope: Array) -> Array:
        """Return derivatives by the amplitudes from derivatives by ln(k/k₀): adjoint of `logs`."""
        found = np.empty(self.size)
        for name, part in self.parts.items():
            scaled = self.scales[name] * slope[part].reshape(self.shapes[name])
            waves = dctn(scaled, norm="ortho")
            found[part] = (self.amplitudes[name] * waves).ravel()
        return found

    def weigh(self, z: Array) -> None:
        """Set the weights of the maps, with edges and slopes of the scars of these amplitudes."""
        view, spacing = self.run(self.logs(z)), self.model.grid.spacing
        for name, (depth, sigma) in self.depths.items():
            worn, placed = view.wear(name), self.placed.get(name, (0.0, 0.0))
            total = np.hypot(sigma, edge_sigma(worn, EDGE_CELL_SIGMA))
            axes = [axis for axis in (0, 1) if placed[axis] and worn.shape[axis] > 1]
            mean = cell_means(worn)
            moves = [placed[axis] * np.gradient(mean, spacing[axis], axis=axis) for axis in axes]
            columns = np.array([np.where(np.isnan(depth), 0.0, each).ravel() for each in moves])
            self.weights[name] = Weights.of(total.ravel(), columns.reshape(-1, depth.size).T)

    def misfit(self, view: View) -> tuple[float, Seeds]:
        """Return half of the weighed sum of the squared residuals, and its derivative."""
        value, seeds = 0.0, {}
        for name, (depth, _) in self.depths.items():
            residuals = np.nan_to_num(cell_means(view.wear(name)) - depth)
            value += 0.5 * float(np.sum(self.weights[name].weigh(residuals.ravel()) ** 2))
            seeds[name] = self.seed(name, residuals)
        return value, Seeds(seeds)

    def seed(self, name: str, residuals: Array) -> Array:
        """Return the derivative of half the weighed sum of squares of residuals, in m, of a map."""
        weights = self.weights[name]
        weighed = weights.weigh_transposed(weights.weigh(residuals.ravel()))
        # `cell_means` is its own adjoint.
        return cell_means(weighed.reshape(residuals.shape))

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
        with closing(Tape()) as tape:
            end = View(model, recorded(model, [time], tape)[time])

            def product(vector: Array) -> Array:
                move = self.logs(vector)
                step = STEP / np.max(np.abs(move))
                moved, seeds = self.run(logs + step * move), {}
                for name, (depth, _) in self.depths.items():
                    change = cell_means(moved.wear(name) - end.wear(name)) / step
                    seeds[name] = self.seed(name, np.where(np.isnan(depth), 0.0, change))
                found = swept_back(model, tape, {time: Seeds(seeds)}, [])
                self.tell(math.nan)
                return self.adjoint(
                    np.concatenate([found.wear_rate[name].ravel() for name in seeds])
                )

            return eigenpairs(product, self.size, products)
