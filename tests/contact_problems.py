"""Contact problems with a known answer."""

import numpy as np

from tribo.contact.dcfft import DcFft
from tribo.core.contact import ContactProblem, ContactSystem
from tribo.core.grid import Grid

MODULUS = 207e9 / (2 * (1 - 0.3**2))
RADIUS = 5e-3
HARDNESS = 4e9
# The load at which Hertz's peak pressure is the hardness.
ONSET = np.pi**3 * RADIUS**2 * HARDNESS**3 / (6 * MODULUS**2)


def problem(
    gap,
    size,
    load,
    cap=None,
    wear=None,
):
    cells = (gap.shape[0], gap.shape[1])
    system = ContactSystem(Grid(size, cells), MODULUS, load, cap)
    return ContactProblem(system, gap, load, wear)


def ball(
    cells,
    load=100.0,
    cap=None,
    radii=(RADIUS, RADIUS),
    width=0.8e-3,
):
    x, y = Grid((width, width), (cells, cells)).mesh
    gap = x**2 / (2 * radii[0]) + y**2 / (2 * radii[1])
    return problem(gap, (width, width), load, cap)


def solver(tolerance=1e-8):
    return DcFft(tolerance=tolerance)


def dense(shape, spacing):
    """Love's influence of every cell on every cell, shape (n, n)."""
    i, j = (v.ravel() for v in np.indices(shape))
    x, y = i * spacing[0], j * spacing[1]
    x, y, (a, b) = x[:, None] - x, y[:, None] - y, (0.5 * spacing[0], 0.5 * spacing[1])
    across = _corner(x + a, y + b) - _corner(x + a, y - b)
    across -= _corner(x - a, y + b) - _corner(x - a, y - b)
    return across / np.pi / MODULUS


def _corner(x, y):
    return x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))
