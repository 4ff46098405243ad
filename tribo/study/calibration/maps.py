"""Coefficients that differ from place to place, from a map of the depth worn off."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.fft import dctn, idctn
from scipy.optimize import minimize
from scipy.special import chdtrc, ndtri

from tribo.case import Case
from tribo.core.arrays import Array, Mask
from tribo.core.errors import CaseError
from tribo.simulation.assembly import assemble, varied
from tribo.simulation.march import begin, march
from tribo.simulation.model import Model
from tribo.simulation.run import Simulation
from tribo.study.calibration.cells import cell_means
from tribo.study.calibration.notes import UNLIKELY
from tribo.study.calibration.quantities import EDGE_CELL_SIGMA, edge_sigma
from tribo.study.gradient.backwards import swept_back
from tribo.study.gradient.gradient import ValueAndGradient
from tribo.study.gradient.local import localised
from tribo.study.gradient.objective import Seeds, View
from tribo.study.gradient.tape import Tape, recorded

STEP = 1e-2
"""Largest change of a logarithm for the derivative of all depths along a direction."""
EACH, LITTLE = 10, 0.2
"""Products with the information of the data until it is seen what each told, and what is little."""
ROUGHLY, ITERATIONS, MEMORY, FALL = 10, 100, 30, 0.05
"""Steps of L-BFGS before, at most after, remembered; and the fall of −ln p that ends it."""
FINE = 0.125
"""Largest cell, in correlation lengths, of a grid that is halved to begin on."""
EXHAUSTED, SILENT = 1e-9, 0.9
"""Part of a new direction that is none, and of the prior's spread where the data say nothing."""


@dataclass(frozen=True)
class Prior:
    """What is known of ln(k/k₀) at each cell before anything is measured: a Gaussian field.

    Its covariance is that of Whittle (1954, Biometrika 41, 434-449), s² (r/ℓ) K₁(r/ℓ), with
    reflecting ends, and as wide there as elsewhere. At the distance ℓ 0.60 of the correlation is
    left.
    """

    spread: float
    length: float
    """The standard deviation s, and the length ℓ, in m."""

    def amplitudes(self, shape: tuple[int, int], spacing: tuple[float, float]) -> Array:
        """Return the relative standard deviations of cosine waves, of the shape of the map."""
        waves = [np.pi * np.arange(n) / (n * h) for n, h in zip(shape, spacing, strict=True)]
        squared = waves[0][:, None] ** 2 + waves[1] ** 2
        planes = np.count_nonzero(np.array(shape) > 1)
        return np.asarray((1 + self.length**2 * squared) ** -(0.5 + 0.25 * planes))

    def level(self, amplitudes: Array) -> Array:
        """Return the factors on a sum of waves that make it as wide as the spread everywhere."""
        waves = [idctn(np.eye(n), axes=[0], norm="ortho") ** 2 for n in amplitudes.shape]
        return np.asarray(self.spread / np.sqrt(waves[0] @ amplitudes**2 @ waves[1].T))


@dataclass(frozen=True, eq=False)
class LocalMap:
    """The factor on a body's wear coefficient at each cell of its surface, shape (rows, ny)."""

    logs: Array
    deviation: Array
    prior: Array
    """The most probable ln(k/k₀), its standard deviation, and that of the prior."""
    spacing: tuple[float, float]
    """Edge lengths of a cell, in m."""
    measured: Array
    computed: Array
    uncertainty: Array
    """The depth measured, NaN where it was not, that of the fit, and the standard deviation of
    what is between them, in m."""

    @property
    def factor(self) -> Array:
        """k/k₀ in the median."""
        return np.exp(self.logs)

    @property
    def told(self) -> Mask:
        """Where the data say something, beyond the prior."""
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
    products: int
    """Gradients, and products with the Hessian, that it took."""
    chi_square: float
    degrees_of_freedom: float
    """Cells that were measured, less Σ λ/(1 + λ) over the eigenvalues of the information."""
    remarks: tuple[str, ...] = ()
    """On the maps as they were measured."""

    @property
    def p_value(self) -> float:
        """Probability of a misfit at least as large by chance."""
        return float(chdtrc(self.degrees_of_freedom, self.chi_square))

    @property
    def notes(self) -> list[str]:
        """Remarks on what the data can tell."""
        notes = list(self.remarks)
        notes += [
            f"{name}: the data say nothing of {np.sum(~each.told)} cells, mostly where nothing was "
            "worn or measured: there the coefficient is the case's, as uncertain as before"
            for name, each in self.maps.items()
            if not np.all(each.told)
        ]
        if self.p_value < UNLIKELY:
            notes.append(
                "no map that varies so smoothly explains the depths: χ² is "
                f"{self.chi_square:.4g} where about {self.degrees_of_freedom:.4g} is expected; the "
                "model leaves something out, or the uncertainty is larger, or the length shorter"
            )
        return notes


def fit_maps(
    case: Case | Mapping[str, Any] | str | Path | Model,
    depths: Mapping[str, tuple[Array, float]],
    priors: Mapping[str, Prior],
    *,
    products: int = 60,
    on_run: Callable[[int, float], None] = lambda count, misfit: None,
) -> FittedMaps:
    """Find the factors on the wear coefficients of bodies that explain maps of their depth.

    The most probable ones, by L-BFGS with exact gradients in waves of the prior. Their standard
    deviations are linearised after its first steps: the information of the data, Jᵀ V⁻¹ J, is
    projected on a Krylov space (Bui-Thanh et al. 2013, SIAM J. Sci. Comput. 35, A2494-A2523), by
    products that are each a run and a pass back, at most so many. What lies beyond is left to the
    prior, so that they come out too large rather than too small. The other steps are taken in
    directions that this makes about equally wide. Where cells are far smaller than the correlation
    lengths, all this is done on a coarser grid first, whose waves are the long ones of the finer.

    `depths` are by the name of the body the mean depth of each cell worn off at the end, in m, of
    the shape of `View.wear`, NaN where it was not measured, and its standard deviation; cells that
    a scar's edge cuts are off by what `edge_sigma` says besides. `on_run` is called after
    each gradient or product with their number and the misfit χ², NaN of a product.
    """
    misfits: list[float] = []

    def tell(misfit: float) -> None:
        misfits.append(misfit)
        on_run(len(misfits), misfit)

    waves = _Waves(Simulation(case).model, depths, priors, tell)
    z, basis, values = waves.fitted(products)
    logs = waves.logs(z)
    fit = waves.run(logs)
    residuals = waves.residuals(fit)
    taken = sum(
        value / (1 + value) * waves.logs(vector) ** 2
        for vector, value in zip(basis, values, strict=True)
    )
    maps = {}
    for name, part in waves.parts.items():
        shape, prior = waves.shapes[name], np.full(waves.shapes[name], priors[name].spread)
        left = prior**2 - taken[part].reshape(shape)
        maps[name] = LocalMap(
            logs[part].reshape(shape),
            np.sqrt(np.maximum(left, 0.0)),
            prior,
            waves.model.grid.spacing,
            depths[name][0],
            cell_means(fit.wear(name)),
            waves.sigma[name],
        )
    read = sum(int(np.sum(~np.isnan(each))) for each in residuals.values())
    made = int(np.sum(np.isnan(misfits)))
    return FittedMaps(
        maps=maps,
        gradients=len(misfits) - made,
        products=made,
        chi_square=sum(float(np.nansum(each**2)) for each in residuals.values()),
        degrees_of_freedom=read - float(np.sum(values / (1 + values))),
    )


class _Waves:
    """Maps as waves of the prior, of independent amplitudes of standard deviation 1."""

    def __init__(
        self,
        model: Model,
        depths: Mapping[str, tuple[Array, float]],
        priors: Mapping[str, Prior],
        tell: Callable[[float], None],
    ) -> None:
        self.model, self.depths, self.priors, self.tell = model, depths, priors, tell
        self.shapes = {name: (model.exposures[name].rows, model.grid.cells[1]) for name in depths}
        self.amplitudes, self.levels, self.parts, self.size = {}, {}, {}, 0
        for name, shape in self.shapes.items():
            if depths[name][0].shape != shape:
                raise CaseError(
                    f"the depth map of {name} has the shape {depths[name][0].shape}, its surface "
                    f"{shape}"
                )
            self.amplitudes[name] = priors[name].amplitudes(shape, model.grid.spacing)
            self.levels[name] = priors[name].level(self.amplitudes[name])
            self.parts[name] = slice(self.size, self.size + shape[0] * shape[1])
            self.size = self.parts[name].stop
        self.sigma: dict[str, Array] = {}
        """Of each cell by the body, with what the grid puts off at a scar's edge, in m."""
        self.gradient = ValueAndGradient(model, self.misfit, (), list(depths))

    def halved(self) -> _Waves | None:
        """Return them on half as many cells; None if those were too large for the maps."""
        case, grid = self.model.case, self.model.grid
        cells = (grid.cells[0] // 2, grid.cells[1] // 2)
        shortest = min(prior.length for prior in self.priors.values())
        if max(grid.spacing) > FINE * shortest or self.model.rough or case.begin is not None:
            return None
        model = assemble(varied(case, grid=grid.model_copy(update={"cells": cells})))
        depths = {}
        for name, (depth, sigma) in self.depths.items():
            shape = (model.exposures[name].rows, cells[1])
            blocks = [n // m for n, m in zip(depth.shape, shape, strict=True)]
            if depth.shape != (shape[0] * blocks[0], shape[1] * blocks[1]):
                return None
            split = depth.reshape(shape[0], blocks[0], shape[1], blocks[1])
            depths[name] = split.mean(axis=(1, 3)), sigma / (blocks[0] * blocks[1]) ** 0.5
        return _Waves(model, depths, self.priors, self.tell)

    def raised(self, coarse: _Waves, z: Array) -> Array:
        """Return amplitudes of another grid's waves on this one, without the shorter waves."""
        found = np.zeros(self.size)
        for name, part in self.parts.items():
            rows, columns = coarse.shapes[name]
            whole = found[part].reshape(self.shapes[name])
            whole[:rows, :columns] = z[coarse.parts[name]].reshape(rows, columns)
        return found

    def fitted(self, products: int) -> tuple[Array, Array, Array]:
        """Return the most probable amplitudes, and eigenvectors and -values of the information."""
        coarse = self.halved()
        if coarse is None:
            near = np.zeros(self.size)
            self.weigh(near)
            near = self.least(near, ROUGHLY)
            self.weigh(near)
            with closing(Tape()) as tape:
                basis, values = _krylov(self.products(self.logs(near), tape), self.size, products)
        else:
            near, basis, values = coarse.fitted(products)
            near = self.raised(coarse, near)
            self.weigh(near)
            basis = np.array([self.raised(coarse, each) for each in basis])
        return self.least(near, ITERATIONS, basis, (1 + values) ** -0.5 - 1), basis, values

    def least(
        self, near: Array, steps: int, basis: Array | None = None, less: Array | None = None
    ) -> Array:
        """Return the most probable amplitudes, or where so many steps lead to, by L-BFGS.

        The posterior is a part `less` narrower than the prior along the rows of the basis.
        """

        def rounded(y: Array) -> Array:
            if basis is None or less is None:
                return y
            along = less * np.sum(basis * y, axis=1)
            return np.asarray(y + np.sum(along[:, None] * basis, axis=0))

        def posterior(y: Array) -> tuple[float, Array]:
            z = near + rounded(y)
            value, slope = self.gradient(self.logs(z))
            self.tell(2 * value)
            return value + 0.5 * float(np.sum(z * z)), rounded(self.back(slope) + z)

        options = {"maxiter": steps, "ftol": 2 * FALL / self.size, "maxcor": MEMORY}
        found = minimize(posterior, 0 * near, jac=True, method="L-BFGS-B", options=options)
        return np.asarray(near + rounded(found.x))

    def logs(self, z: Array) -> Array:
        """Return the logarithms of the factors of amplitudes."""
        found = np.empty(self.size)
        for name, part in self.parts.items():
            waves = self.amplitudes[name] * z[part].reshape(self.shapes[name])
            found[part] = (self.levels[name] * idctn(waves, norm="ortho")).ravel()
        return found

    def back(self, slope: Array) -> Array:
        """Return derivatives in the amplitudes from those in the logarithms."""
        found = np.empty(self.size)
        for name, part in self.parts.items():
            levelled = self.levels[name] * slope[part].reshape(self.shapes[name])
            waves = dctn(levelled, norm="ortho")
            found[part] = (self.amplitudes[name] * waves).ravel()
        return found

    def weigh(self, z: Array) -> None:
        """Set the standard deviations of cells: the edge is where amplitudes have it."""
        view = self.run(self.logs(z))
        for name, (_, sigma) in self.depths.items():
            self.sigma[name] = np.hypot(sigma, edge_sigma(view.wear(name), EDGE_CELL_SIGMA))

    def residuals(self, view: View) -> dict[str, Array]:
        """Return the computed less the measured depths, in standard deviations."""
        return {
            name: (cell_means(view.wear(name)) - depth) / self.sigma[name]
            for name, (depth, _) in self.depths.items()
        }

    def misfit(self, view: View) -> tuple[float, Seeds]:
        """Return half of the sum of the squared residuals, and its derivative."""
        off = {name: np.nan_to_num(each) for name, each in self.residuals(view).items()}
        value = 0.5 * sum(float(np.sum(each * each)) for each in off.values())
        # Means over cells are their own adjoint.
        seeds = {name: cell_means(each / self.sigma[name]) for name, each in off.items()}
        return value, Seeds(seeds)

    def local(self, logs: Array) -> Model:
        """Return the model with factors of these logarithms."""
        return localised(self.model, self.gradient.at(logs)[1])

    def run(self, logs: Array) -> View:
        """Return the end of a run with factors of these logarithms."""
        model = self.local(logs)
        *_, last = march(model, begin(model))
        return View(model, last.state)

    def products(self, logs: Array, tape: Tape) -> Callable[[Array], Array]:
        """Return the product of Jᵀ V⁻¹ J about a map with amplitudes, as a function."""
        model, time = self.local(logs), self.model.end_time
        end = View(model, recorded(model, [time], tape)[time])

        def product(z: Array) -> Array:
            move = self.logs(z)
            step = STEP / np.max(np.abs(move))
            moved, seeds = self.run(logs + step * move), {}
            for name, (depth, _) in self.depths.items():
                change = cell_means(moved.wear(name) - end.wear(name)) / step
                known = np.where(np.isnan(depth), 0.0, change / self.sigma[name] ** 2)
                seeds[name] = cell_means(known)
            found = swept_back(model, tape, {time: Seeds(seeds)}, [])
            self.tell(math.nan)
            return self.back(np.concatenate([found.wear_rate[name].ravel() for name in seeds]))

        return product


def _krylov(product: Callable[[Array], Array], size: int, most: int) -> tuple[Array, Array]:
    """Return approximate eigenvectors, as rows, and eigenvalues, by Lanczos' method."""
    vector = np.random.default_rng(0).standard_normal(size)
    basis = images = np.empty((0, size))
    projected, known = np.empty((0, 0)), 0.0
    while len(basis) < min(most, size):
        whole = np.sum(vector**2)
        for _ in range(2):
            along = np.sum(basis * vector, axis=1)
            vector = vector - np.sum(along[:, None] * basis, axis=0)
        left = np.sum(vector**2)
        if left <= EXHAUSTED**2 * whole:
            break
        basis = np.vstack([basis, vector / left**0.5])
        vector = product(basis[-1])
        images = np.vstack([images, vector])
        projected = basis @ images.T
        projected = 0.5 * (projected + projected.T)
        if len(basis) % EACH == 0:
            # Σ λ/(1 + λ) over its eigenvalues.
            inverse = np.linalg.inv(np.eye(len(basis)) + projected)
            former, known = known, len(basis) - float(np.trace(inverse))
            if known - former < LITTLE * EACH:
                break
    values, turned = np.linalg.eigh(projected)
    return turned.T @ basis, np.maximum(values, 0.0)
