"""The displacement of coated half-spaces: what the base adds to Love's kernel of the layer."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache

import numpy as np
import scipy

from tribo.core.arrays import Array
from tribo.core.coating import Coating

_END = 20.0
"""Wavenumber times thickness from which the base has no influence: e^(−2ξ) is rounding."""
_FAR = 256.0
"""Distance from a load, in thicknesses, from which the layer does not count: (1/256)² is left."""
_POINTS = 500
"""Of the table: with 500 the kernel is exact to 4e-10 of its largest value, with 250 to 7e-9."""
_NEAR = 8
"""Cells around the load over which the pressure of a cell is integrated exactly: 8 leave 5e-10 of
the largest value, 4 leave 2e-8."""


def base_kernel(
    shape: tuple[int, int], spacing: tuple[float, float], coatings: Iterable[Coating]
) -> Array:
    """Return the displacement due to the bases, in the order a circular convolution needs.

    For a point load it is the Hankel transform of `Coating.influence`, smooth over the
    thickness and, unlike the transform on a grid, without images and with its 1/r
    (the correction near q = 0 of Liu & Wang 2002, J. Tribol. 124, 36-45, is not needed). It is
    integrated over the cell: exactly near it, by Gauss's rule further off.

    Shape, spacing and order are as in `tribo.contact.love.wrapped_kernel`; the displacement is
    for p = 1, in m/Pa. `coatings` are the coatings of both bodies.
    """
    halves = [n // 2 + 1 for n in shape]
    quarter = np.zeros(halves)
    furthest = float(np.hypot(halves[0] * spacing[0], halves[1] * spacing[1]))
    near = [min(n, _NEAR) for n in halves]
    for coating in coatings:
        # Boxes of about the same size share one table.
        reach = 2.0 ** np.ceil(np.log2(furthest / coating.thickness))
        load = _point_load(coating, max(float(reach), 1.0))
        part = _by_gauss(load, halves, spacing)
        part[: near[0], : near[1]] = _exact(load, near, spacing)
        quarter += part
    i, j = (np.minimum(np.arange(n), n - np.arange(n)) for n in shape)
    return np.asarray(quarter[np.ix_(i, j)])


class _PointLoad:
    """What the base adds to the displacement under a unit load, g(r), in m/N.

    It is tabulated up to `reach`, in thicknesses; or less, where it has become 1/r.
    """

    def __init__(self, coating: Coating, reach: float) -> None:
        # A stiff layer bends, over lengths that grow with the cube root of its stiffness.
        base = coating.base.young / (1 - coating.base.poisson**2)
        reach = min(reach, _FAR * max(1.0, (coating.modulus / base) ** (1 / 3)))
        # Dense near the load, and ever wider apart where it falls like 1/r.
        r = np.sinh(np.linspace(0, np.arcsinh(8 * reach), _POINTS)) / 8
        xi, weights = _panels(reach)
        influence = weights * coating.influence(xi / coating.thickness)
        # Not a product of matrices, whose sums depend on threads.
        values = np.array([np.sum(scipy.special.j0(each * xi) * influence) for each in r])
        values /= np.pi * coating.modulus * coating.thickness
        self._last = coating.thickness * reach
        self._tail = (1 / base - 1 / coating.modulus) / np.pi
        r *= coating.thickness
        self._green = scipy.interpolate.CubicSpline(r, values)
        self._integral = scipy.interpolate.CubicSpline(r, values * r).antiderivative()

    def green(self, r: Array) -> Array:
        near = np.minimum(r, self._last)
        return np.where(r > near, self._tail / np.maximum(r, self._last), self._green(near))

    def integral(self, r: Array) -> Array:
        near = np.minimum(r, self._last)
        return np.asarray(self._integral(near) + self._tail * (r - near))


_point_load = lru_cache(_PointLoad)


def _panels(reach: float) -> tuple[Array, Array]:
    """Return nodes and weights on [0, _END]: narrow near 0, and a few waves of J0 at most."""
    edges = [0.0]
    while edges[-1] < _END:
        edges.append(min(edges[-1] + min(0.01 + 0.5 * edges[-1], 16 / reach, 2.0), _END))
    nodes, weights = np.polynomial.legendre.leggauss(16)
    starts, widths = np.array(edges[:-1])[:, None], np.diff(edges)[:, None]
    return (starts + 0.5 * widths * (1 + nodes)).ravel(), (0.5 * widths * weights).ravel()


def _by_gauss(load: _PointLoad, cells: Iterable[int], spacing: tuple[float, float]) -> Array:
    """Return the integral of g over cells at offsets (i, j), by three points an axis."""
    nodes, weights = np.polynomial.legendre.leggauss(3)
    total = np.zeros(tuple(cells))
    x, y = (np.arange(n) * d for n, d in zip(total.shape, spacing, strict=True))
    for a, wa in zip(nodes, weights, strict=True):
        for b, wb in zip(nodes, weights, strict=True):
            away = np.hypot((x + 0.5 * spacing[0] * a)[:, None], y + 0.5 * spacing[1] * b)
            total += 0.25 * wa * wb * load.green(away)
    return total * spacing[0] * spacing[1]


def _exact(load: _PointLoad, cells: Iterable[int], spacing: tuple[float, float]) -> Array:
    """Return the integral of g over cells at offsets (i, j), from those over right triangles."""
    x, y = ((np.arange(n + 1) - 0.5) * d for n, d in zip(cells, spacing, strict=True))
    x, y = np.meshgrid(x, y, indexing="ij")
    nodes, weights = np.polynomial.legendre.leggauss(48)
    corner = np.zeros(x.shape)
    for s, t in ((np.abs(x), np.abs(y)), (np.abs(y), np.abs(x))):
        # ∫ over the triangle beside the edge at s: the radius ends at s / cos θ.
        widest = np.arctan2(t, s)
        for node, weight in zip(nodes, weights, strict=True):
            angle = 0.5 * widest * (1 + node)
            corner += 0.5 * widest * weight * load.integral(s / np.cos(angle))
    corner *= np.sign(x) * np.sign(y)
    return np.diff(np.diff(corner, axis=0), axis=1)
