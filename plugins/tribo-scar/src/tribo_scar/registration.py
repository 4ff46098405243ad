"""Registration of height maps measured before and after a test."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.ndimage as ndimage
from tribo import Array, CaseError, Heights, Mask
from tribo.kernel_api import nearest_filled

from tribo_scar.alignment import OVERLAP, align, robust_deviation, rotation
from tribo_scar.smoothing import smoothed

SAME = 1e-3
"""Relative difference up to which two pitches are the same: half a pixel over 500."""
TEXTURE = 3.0
"""Eigenvalue of the normal matrix, relative to noise, above which a direction of shift and rotation
is determined."""
TUKEY = 4.685
"""Tukey's constant: residual of weight 0, in standard deviations (95 % efficiency; Huber 1981)."""
DEEP = 4.0
"""Standard deviations of noise above which a difference is a scar: chance has one pixel in
16,000."""
ROUNDING = 1e-4
"""Least noise, relative to the largest depth."""
ROUNDED = 1e-7
"""Rounding of heights in files, single precision, relative to their range; less does not determine
a shift."""
BLOCKS = 8
"""Blocks along the shorter edge of the map, whose sums give the correlation of noise."""
BLURS = 4.0, 2.0, 1.0
"""Widths of the Gaussian blur, from coarse to fine, in pixels."""
ITERATIONS = 30
"""Gauss-Newton steps per blur."""
SETTLED = 1e-3
"""Change in a step that ends the last blur, of the map's place in pixels and of its form in
standard deviations of noise."""


@dataclass(frozen=True)
class Registration:
    """Registration of two maps on their common area.

    Parameters
    ----------
    part : tuple of slice
        Pixels of the map after that have a depth, along x and y.
    depth : ndarray, shape (nx, ny)
        Height before less height after, in m; NaN where either is missing.
    uncertainty : ndarray, shape (nx, ny)
        Standard uncertainty of the depth, by noise and registration, in m.
    shift, shift_uncertainty : tuple of float
        Offset, in the map after, of the middle of the map before from its own middle, in m. The
        uncertainty is infinite where the maps do not determine it: a shift of a smooth ball looks
        like a tilt. If nothing is determined the map is not moved.
    rotation, rotation_uncertainty : float
        Anticlockwise, of the surface in the map after against the map before, in rad.
    noise : float
        Standard deviation of the unworn differences, in m.
    worn : ndarray of bool, shape (nx, ny)
        The pixels that were left out as worn or piled up.
    slopes : ndarray, shape (p, nx, ny)
        Jacobian: derivative of the depth by each parameter of the registration.
    covariance : ndarray, shape (p, p)
        Covariance of the parameters.
    variance_inflation : float
        Variance of a sum of noise, relative to noise without correlation of neighbours.
    """

    part: tuple[slice, slice]
    depth: Array
    uncertainty: Array
    shift: tuple[float, float]
    shift_uncertainty: tuple[float, float]
    rotation: float
    rotation_uncertainty: float
    noise: float
    worn: Mask
    slopes: Array
    covariance: Array
    variance_inflation: float

    @property
    def unworn(self) -> Mask:
        """The pixels in common that are not left out, shape (nx, ny)."""
        unworn: Mask = np.isfinite(self.depth) & ~self.worn
        return unworn


def register(before: Heights, after: Heights, form: int = 1) -> Registration:
    """Register a map measured after a test with one measured before it.

    Fits a shift, a rotation about z and a polynomial form of order `form` in x and y to the unworn
    surface, by least squares with Tukey's weights. The scar is detected and left out. The fit
    starts from `align`. Directions of shift and rotation that the relief does not determine, as on
    smooth bodies, are not fitted.

    Raises
    ------
    CaseError
        If the maps have another pitch, do not overlap, or no unworn surface is left.

    References
    ----------
    Baker, S., Matthews, I. (2004), Lucas-Kanade 20 years on, Int. J.
    Comput. Vis. 56, 221-255. White, H. (1980), A heteroskedasticity-consistent covariance matrix
    estimator, Econometrica 48, 817-838.
    """
    if not np.allclose(before.pitch, after.pitch, rtol=SAME, atol=0):
        first, second = (
            " × ".join(f"{1e6 * each:.6g}" for each in m.pitch) + " µm" for m in (before, after)
        )
        raise CaseError(
            f"the map before has a pixel every {first}, and that after every {second}; measure or "
            "resample them alike"
        )
    fit = _Fit(before, after, form, *align(before, after))
    fit.run()
    if not fit.determined.size:
        fit = _Fit(before, after, form, np.zeros(2), 0.0)
        fit.run(moves=False)
    return fit.outcome()


class _Fit:
    """Gauss-Newton fit of shift, rotation and form, on the pixels of the map after."""

    def __init__(
        self, before: Heights, after: Heights, form: int, shift: Array, angle: float
    ) -> None:
        self.before, self.after, self.pitch = before, after, np.array(after.pitch)
        self.shift, self.angle = shift, angle
        self.places = np.stack(np.broadcast_arrays(*after.grid.mesh))
        self.lever = float(np.sqrt(np.mean(np.sum(self.places**2, axis=0))))
        places = np.stack(np.broadcast_arrays(*before.grid.mesh))
        terms, known = quadratic(places, self.lever)[0], np.isfinite(before.heights)
        middle, terms_of = np.mean(before.heights[known]), terms[:, known]
        inverse = np.linalg.pinv(np.einsum("kn,ln->kl", terms_of, terms_of), hermitian=True)
        centred = np.einsum("kn,n->k", terms_of, before.heights[known] - middle)
        self.quadratic = np.einsum("kl,l->k", inverse, centred)
        """The form of the map before."""
        self.relief = nearest_filled(before.heights - np.tensordot(self.quadratic, terms, 1))
        own = np.tensordot(self.quadratic, quadratic(self.places, self.lever)[0], 1)
        self.filled = own + nearest_filled(after.heights - own)
        x, y = self.places / np.max(np.abs(self.places))
        self.form = np.stack([x**i * y**j for i in range(form + 1) for j in range(form + 1 - i)])
        self.factors = np.zeros(len(self.form))
        self.worn = np.zeros(after.heights.shape, dtype=bool)
        self.determined = np.zeros((3, 0))
        """Directions of shift, and rotation times lever, that the relief determines."""

    def run(self, *, moves: bool = True) -> None:
        """Fit maps from coarse to fine; the form alone unless the map `moves`."""
        self._settle(BLURS[0], first=True, still=True)
        for blur in BLURS:
            self._settle(blur, still=not moves)

    def _settle(self, blur: float, *, first: bool = False, still: bool = False) -> None:
        for _ in range(ITERATIONS):
            if self._improve(blur, first=first, still=still) < SETTLED * blur**2:
                break

    def difference(self, blur: float) -> tuple[Array, Array]:
        """Return the depth, and its derivatives by shift, rotation times lever and form."""
        x, y = rotated = np.einsum("ij,jxy->ixy", rotation(self.angle), self.places)
        position = rotated + self.shift[:, None, None]
        middle = 0.5 * (np.array(self.relief.shape) - 1)
        at = position / self.pitch[:, None, None] + middle[:, None, None]
        # Without form, as blur is one-sided at the border and would bend it.
        form, *bends = (
            np.tensordot(self.quadratic, each, 1) for each in quadratic(position, self.lever)
        )
        relief = self.relief
        rest = self.filled - form - np.tensordot(self.factors, self.form, 1)
        if blur:
            relief, rest = (ndimage.gaussian_filter(each, blur) for each in (relief, rest))
        by_x, by_y = (
            bend + ndimage.map_coordinates(slope, at, order=1, mode="nearest")
            for bend, slope in zip(bends, np.gradient(relief, *self.pitch), strict=True)
        )
        slopes = np.stack([by_x, by_y, (by_y * x - by_x * y) / self.lever, *self.form])
        depth = ndimage.map_coordinates(relief, at, order=3, mode="nearest") - rest
        missing = np.isnan(self.before.heights).astype(float)
        missing = ndimage.map_coordinates(missing, at, order=1, mode="constant", cval=1.0)
        return np.where((missing > 1e-6) | np.isnan(self.after.heights), np.nan, depth), slopes

    def _improve(self, blur: float, *, first: bool, still: bool) -> float:
        """Take a Gauss-Newton step, and return its change as `SETTLED` has it."""
        depth, slopes = self.difference(blur)
        known = np.isfinite(depth)
        if np.count_nonzero(known) < OVERLAP * known.size:
            raise CaseError(
                f"the maps have only {100 * np.mean(known):.0f} % of the pixels in common; "
                f"{100 * OVERLAP:.0f} % at least are needed"
            )
        if not first:
            self._find_scar(depth)
        used = known & ~self.worn
        if np.count_nonzero(used) < 0.1 * np.count_nonzero(known):
            raise CaseError(
                "hardly any unworn surface is left to register the maps by; measure a larger area"
            )
        residuals, columns = depth[used], slopes[:, used]
        scale = robust_deviation(residuals)
        if first:
            # The form through the median, which a scar affects least.
            weights = 1 / np.maximum(np.abs(residuals), 1e-3 * scale + 1e-30)
        else:
            # Without noise residuals may have an offset far larger than their deviation.
            most = TUKEY * max(scale, float(np.median(np.abs(residuals)))) + 1e-30
            weights = np.maximum(1 - (residuals / most) ** 2, 0) ** 2
        weights /= np.max(weights)
        normal = np.einsum("kn,ln->kl", columns * weights, columns)
        descent = -np.einsum("kn,n->k", columns * weights, residuals)
        # The form is eliminated by the Schur complement.
        inverse = np.linalg.pinv(normal[3:, 3:], hermitian=True)
        coupling = normal[:3, 3:] @ inverse
        values, vectors = np.linalg.eigh(normal[:3, :3] - coupling @ normal[3:, :3])
        # Half of the noise is in the map before. Correlated noise has less steep slopes than
        # white noise, which the residuals show once the maps are registered.
        white = (scale / (blur * np.min(self.pitch))) ** 2 / 2
        seen = (
            robust_deviation(slope[used & np.isfinite(slope)]) ** 2
            for slope in np.asarray(np.gradient(depth, *self.pitch))
        )
        rounded = (ROUNDED * np.ptp(self.filled) / np.min(self.pitch)) ** 2
        steepness = max(min(white, max(seen)), rounded)
        kept = values > TEXTURE * np.sum(weights) * 0.5 * steepness
        self.determined = vectors[:, kept]
        moves = np.zeros(3)
        if not still:
            along = self.determined.T @ (descent[:3] - coupling @ descent[3:])
            moves = self.determined @ (along / values[kept])
        bends = inverse @ (descent[3:] - normal[3:, :3] @ moves)
        self.factors += bends
        self.shift = self.shift + moves[:2]
        self.angle += moves[2] / self.lever
        steps = *np.abs(moves) / np.min(self.pitch), *np.abs(bends) / (scale + 1e-30)
        return float(np.max(steps))

    def _find_scar(self, depth: Array) -> None:
        smooth = smoothed(depth)
        # Negative depths are noise without a scar.
        raised = smooth[np.isfinite(depth) & (smooth <= 0)]
        noise = 1.4826 * float(np.median(-raised)) if raised.size else 0.0
        # Maps without noise differ by rounding.
        noise = max(noise, ROUNDING * float(np.max(smooth)))
        # Relief that is not registered yet has deep spots, smaller than a scar.
        worn = ndimage.binary_opening(np.abs(smooth) > DEEP * noise, iterations=3)
        if np.mean(worn) < 0.8:
            self.worn = ndimage.binary_dilation(worn)

    def outcome(self) -> Registration:
        """Return the registration, with covariance and uncertainty."""
        blurred, slopes = self.difference(1.0)
        used = np.isfinite(blurred) & ~self.worn
        columns = np.where(used, slopes, 0.0)
        basis = np.eye(len(slopes))
        basis[:3, :3] = self.determined @ self.determined.T
        normal = basis @ np.einsum("kxy,lxy->kl", columns, columns) @ basis
        # White (1980): a covariance that holds for noise that is correlated.
        bread = np.linalg.pinv(normal, rcond=1e-12, hermitian=True)
        covariance = bread @ _sums(columns * np.where(used, blurred, 0.0)) @ bread
        depth, _ = self.difference(0.0)
        noise = robust_deviation(depth[used])
        from_fit = np.einsum("kxy,kl,lxy->xy", slopes, covariance, slopes, optimize=True)
        uncertainty = np.sqrt(noise**2 + np.maximum(from_fit, 0))
        # The middle of the map before lies in that after where the middle of that one comes from.
        back = rotation(-self.angle)
        by_turn = rotation(0.5 * np.pi - self.angle) @ self.shift / self.lever
        moves = np.block([[-back, by_turn[:, None]], [np.zeros(2), -1.0]])
        of_moves = moves @ covariance[:3, :3] @ moves.T
        sigmas = np.sqrt(np.maximum(np.diag(of_moves), 0))
        sigmas[np.diag(basis)[:3] < 0.5] = np.inf
        x, y = -back @ self.shift
        part = _common_area(depth)
        return Registration(
            part=part,
            depth=depth[part],
            uncertainty=np.where(np.isfinite(depth), uncertainty, np.nan)[part],
            shift=(float(x), float(y)),
            shift_uncertainty=(float(sigmas[0]), float(sigmas[1])),
            rotation=-float(self.angle),
            rotation_uncertainty=float(sigmas[2] / self.lever),
            noise=noise,
            worn=self.worn[part],
            slopes=slopes[:, *part],
            covariance=covariance,
            variance_inflation=variance_inflation(np.where(used, depth, np.nan)),
        )


def _common_area(depth: Array) -> tuple[slice, slice]:
    """Return the rows and columns of which half is known, from the first to the last."""
    known = np.isfinite(depth)
    parts = (np.mean(known, axis=1), np.mean(known, axis=0))
    lines = [np.flatnonzero(part >= 0.5 * np.max(part)) for part in parts]
    along, across = (slice(int(each[0]), int(each[-1]) + 1) for each in lines)
    return along, across


def quadratic(places: Array, scale: float) -> Array:
    """Return the terms of a quadratic form at places, and their derivatives along x and y."""
    x, y = places / scale
    one, none = np.ones_like(x), np.zeros_like(x)
    along, across = [none, one, none, 2 * x, y, none], [none, none, one, none, x, 2 * y]
    value = [one, x, y, x**2, x * y, y**2]
    return np.stack([value, np.array(along) / scale, np.array(across) / scale])


def variance_inflation(values: Array) -> float:
    """Return the variance of a sum of values, relative to independent values."""
    known = np.isfinite(values)
    centred = np.where(known, values - np.mean(values[known]), 0.0)
    return max(1.0, float(_sums(centred[None])[0, 0]) / max(float(np.sum(centred**2)), 1e-300))


def _sums(scores: Array) -> Array:
    """Return the covariance of the sums over the map of residuals' scores, shape (p, nx, ny).

    It is the covariance of sums over all blocks of a size, extrapolated from two sizes to large
    blocks, where neighbours of another block no longer count.
    """
    edge = max(BLOCKS, min(scores.shape[1:]) // BLOCKS)
    padded = np.pad(scores, ((0, 0), (edge, edge), (edge, edge)))
    half, whole = (
        np.einsum("kxy,lxy->kl", each, each)
        for n in (edge // 2, edge)
        for each in [n * ndimage.uniform_filter(padded, (0, n, n), mode="constant")]
    )
    ratio = np.diag(half) / np.maximum(np.diag(whole), 1e-300)
    more = np.sqrt(np.clip(2 - ratio, 1, 2))
    # The fit takes one block's freedom for each of its parameters.
    blocks = np.count_nonzero(np.any(scores, axis=0)) / edge**2
    return np.asarray(whole * np.outer(more, more) / max(1 - len(scores) / max(blocks, 1), 0.25))
