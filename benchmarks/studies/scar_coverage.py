"""How often the stated uncertainties of `tribo scar` hold, on pairs of maps whose scar is known.

A worn flat or ball with relief, 96² to 160² pixels; the map after is shifted, turned and tilted:

    python -m benchmarks.studies.scar_coverage docs/_data/scar_coverage.json
"""

import json
import sys
import warnings
from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd
import scipy.ndimage as ndimage
from tribo_scar import measured_scar

from tribo import Heights, TriboError, TriboWarning

PITCHES = 1e-6, 2e-6, 4e-6
NOISES = 10e-9, 30e-9
CORRELATED = 0.0, 2.0
"""Width of the Gaussian that noise is correlated by, in pixels."""
SCARS = "flat on a ball", "groove", "flat-bottomed"
PAIRS = 8
"""Of each combination."""
WIDER = 4.0, 6.0, 12.0
"""Widths of correlation for the first scar alone."""
RELIEF, RADIUS = 100e-9, 5e-3
WITHIN = 1.96


def noise(random, shape, sigma, width):
    """Return noise of a standard deviation, correlated over some pixels."""
    field = random.normal(size=shape)
    if width:
        field = ndimage.gaussian_filter(field, width, mode="wrap")
    return sigma * field / np.std(field)


def lost(kind, x, y, half, depth):
    """Return the depth of a scar of half a width at places."""
    if kind == "groove":
        return np.maximum(depth * (1 - (y / half) ** 2), 0.0)
    if kind == "flat-bottomed":
        return np.where(np.hypot(x, y) < half, depth, 0.0)
    return np.maximum(depth * (1 - (x**2 + y**2) / half**2), 0.0)


def pair(random, kind, pitch, sigma, width):
    """Return maps before and after, and what is true of them, in SI units."""
    n = int(random.integers(96, 161))
    shift, turn = random.uniform(-6, 6, 2), random.uniform(-0.02, 0.02)
    half, depth = n * pitch * random.uniform(0.14, 0.24), random.uniform(0.3e-6, 3e-6)
    relief = ndimage.gaussian_filter(random.normal(size=(2 * n, 2 * n)), 3.0)
    relief *= RELIEF / np.std(relief)
    own = np.indices((n, n)) - 0.5 * (n - 1)
    c, s = np.cos(turn), np.sin(turn)
    at = np.stack([c * own[0] - s * own[1] + shift[0], s * own[0] + c * own[1] + shift[1]])
    surfaces = []
    for where in (own, at):
        found = ndimage.map_coordinates(relief, where + n - 0.5, order=5)
        if kind == "flat on a ball":
            found = found - np.sum((where * pitch) ** 2, axis=0) / (2 * RADIUS)
        surfaces.append(found)
    # The groove runs along x of the map after, so that it is not askew.
    depths = lost(kind, *pitch * own, half, depth)
    tilt = pitch * (2e-3 * own[0] - 1e-3 * own[1])
    maps = []
    for heights in (surfaces[0], surfaces[1] - depths + tilt):
        heights = heights + noise(random, heights.shape, sigma, width)
        heights[random.random(heights.shape) < 0.01] = np.nan
        maps.append(Heights(heights, (pitch, pitch)))
    # Where the middle of the map before lies in that after.
    seen = -pitch * np.array([c * shift[0] + s * shift[1], c * shift[1] - s * shift[0]])
    truth = {"shift": seen, "rotation": -turn, "depth": depth, "width": 2 * half}
    return *maps, depths, truth


def errors(random, kind, pitch, sigma, width):
    """Return the errors of what is measured of a pair, in standard uncertainties."""
    before, after, depths, truth = pair(random, kind, pitch, sigma, width)
    found = measured_scar(before, after)
    laid = found.registration
    off = {
        "rotation": (laid.rotation - truth["rotation"]) / laid.rotation_uncertainty,
        "depth": (found.depth - truth["depth"]) / found.depth_uncertainty,
        "width": (found.across - truth["width"]) / found.across_uncertainty,
        "volume": (found.volume - np.sum(depths[laid.part]) * pitch**2) / found.volume_uncertainty,
        "volume, %": 100 * (found.volume / (np.sum(depths[laid.part]) * pitch**2) - 1),
    }
    for axis, name in enumerate("xy"):
        error = laid.shift[axis] - truth["shift"][axis]
        off[f"shift {name}"] = error / laid.shift_uncertainty[axis]
    return off


def main():
    """Measure all pairs, and write the shares whose errors are within 1.96 uncertainties."""
    random, rows, refused = np.random.default_rng(2026), [], 0
    wider = [(SCARS[0], PITCHES[1], NOISES[0], width) for width in WIDER]
    for kind, pitch, sigma, width in [*product(SCARS, PITCHES, NOISES, CORRELATED), *wider]:
        for _ in range(4 * PAIRS if width in WIDER else PAIRS):
            try:
                off = errors(random, kind, pitch, sigma, width)
            except TriboError as error:
                print(kind, pitch, sigma, width, error, flush=True)
                refused += 1
                continue
            rows.append({"scar": kind, "pitch": pitch, "noise": sigma, "over": width, **off})
    every = pd.DataFrame(rows)
    names = ["shift x", "shift y", "rotation", "depth", "width", "volume"]
    held, table = every[names].abs() <= WITHIN, every[~every["over"].isin(WIDER)]
    data = {
        "pairs": len(table),
        "refused": refused,
        "held": held.loc[table.index].mean().round(3).to_dict(),
        "held_by_scar": held.groupby(table["scar"]).mean().round(3).to_dict("index"),
        "held_by_correlation": held.groupby(every["over"]).mean().round(3).to_dict("index"),
        "volume_rms_percent": float(np.sqrt(np.mean(table["volume, %"] ** 2)).round(3)),
    }
    Path(sys.argv[1]).write_text(json.dumps(data, indent=2) + "\n")
    print(json.dumps(data, indent=2))


if __name__ == "__main__":
    warnings.simplefilter("ignore", TriboWarning)
    main()
