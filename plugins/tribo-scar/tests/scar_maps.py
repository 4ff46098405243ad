"""Pairs of maps before and after a test that are made up."""

import numpy as np
import scipy.ndimage as ndimage
from tribo import Grid, Heights, Rough

PITCH = 1e-6
SHIFT, TURN = (3.37, -2.21), 0.01
RADIUS = 5e-3
WIDE = 20 * PITCH
"""Half-width of the scars."""


def pair(
    *, shift=SHIFT, turn=TURN, sq=100e-9, noise=10e-9, depth=1e-6, missing=0.02, on=None, n=96
):
    """Return maps before and after, shifted (pixels), turned, tilted, and the depth worn."""
    random = np.random.default_rng(7)
    large = Grid(2 * n * PITCH, 2 * n)
    waves = {"cut_off": 8 * PITCH, "roll_off": 30 * PITCH, "period": 2 * n * PITCH}
    surface = Rough(sq=sq, seed=3, **waves).relief(large)
    own = np.indices((n, n)) - 0.5 * (n - 1)

    def heights(shift, turn):
        c, s = np.cos(turn), np.sin(turn)
        at = np.stack([c * own[0] - s * own[1] + shift[0], s * own[0] + c * own[1] + shift[1]])
        form = 0 if on is None else -np.sum((at * PITCH) ** 2, axis=0) / (2 * on)
        return ndimage.map_coordinates(surface, at + n - 0.5, order=5) + form, at * PITCH

    (before, _), (after, (x, y)) = heights((0, 0), 0), heights(shift, turn)
    lost = cap(x, y, depth)
    after = after - lost + PITCH * (2e-3 * own[0] - 1e-3 * own[1]) + 1e-5
    maps = []
    for each in (before, after):
        noisy = each + noise * random.normal(size=each.shape)
        noisy[random.random(each.shape) < missing] = np.nan
        maps.append(Heights(noisy, (PITCH, PITCH)))
    return *maps, lost


def seen(shift=SHIFT, turn=TURN):
    """Return where the middle of the map before lies in that after, in pixels."""
    c, s = np.cos(turn), np.sin(turn)
    return -np.array([c * shift[0] + s * shift[1], c * shift[1] - s * shift[0]])


def cap(x, y, depth=1e-6, wide=WIDE):
    """Return the depth of a cap of a ball, or of a groove where one place is 0."""
    return np.maximum(depth * (1 - (x**2 + y**2) / wide**2), 0)


def of_flat(lost, noise=3e-9, seed=0, pitch=PITCH, missing=False):
    """Return the map of a flat after a test, with noise, but what is missing."""
    heights = np.random.default_rng(seed).normal(0, noise, np.shape(lost)) - lost
    return Heights(np.where(missing, np.nan, heights), (pitch, pitch))


def places(n=96, pitch=PITCH):
    """Return x and y of all pixels."""
    return np.meshgrid(*[(np.arange(n) - 0.5 * (n - 1)) * pitch] * 2, indexing="ij")


def volume(lost):
    return np.sum(lost) * PITCH**2


def worn(shape, **changes):
    """Return maps before and after, and the depth worn: a function of pixels, in µm."""
    before, after, _ = pair(depth=0, **changes)
    lost = 1e-6 * np.maximum(shape(*(each / PITCH for each in after.grid.mesh)), 0)
    lost = np.broadcast_to(lost, after.heights.shape)
    return before, Heights(after.heights - lost, after.pitch), lost


def track(wide=WIDE):
    deepest = 1e7 * wide**2 / RADIUS
    return worn(lambda x, y: deepest * (1 - (y * PITCH / wide) ** 2), shift=(15.3, 0))


def grooved(depth, **changes):
    """Return maps of a groove whose edges are flat, as of a contact that has grown."""
    still = {"shift": (0, 0), "turn": 0, "sq": 5e-8}
    lost = lambda x, y: 1e6 * depth * np.maximum(1 - np.abs(y) * PITCH / WIDE, 0) ** 1.5  # noqa: E731
    return worn(lost, **still, **changes)
