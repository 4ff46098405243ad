"""How often intervals of `tribo calibrate` cover the truth, and how many tests are enough.

Each lab weighs balls and disks of tests at two loads, with Archard's law as the forward run:

    python -m benchmarks.studies.calibration_coverage docs/_data/calibration_coverage.json
"""

import json
import sys
import time
from pathlib import Path

import numpy as np
from scipy.stats import binom
from tribo_inverse.calibration.fit import fit, interval
from tribo_inverse.calibration.linearised import Problem
from tribo_inverse.calibration.plan import Search

LABS, LEVEL = 1000, 0.95
DENSITY, DISTANCE = 7850.0, 360.0
TRUE = np.array([7.08e-15, 7.08e-16])
MG = 1e-6
SETTINGS = {
    "one test, weighed": {"loads": [100], "tests": 1, "scatter": 0.0},
    "five tests alike": {"loads": [100], "tests": 5, "scatter": 0.2},
    "two loads, four tests each": {"loads": [50, 100], "tests": 4, "scatter": 0.2},
    "the same, repeatability stated": {
        "loads": [50, 100],
        "tests": 4,
        "scatter": 0.2,
        "stated": True,
    },
}
NOISE = 0.02
"""Standard deviation of a weighing, mg."""


def covered(loads, tests, scatter, random, stated=False):
    """Return which of the two coefficients' intervals of a lab cover."""
    found, ends = lab(loads, tests, scatter, random, stated)
    truth = np.log(TRUE) - found.point
    return [low <= value <= high for (low, high), value in zip(ends, truth, strict=True)]


def lab(loads, tests, scatter, random, stated=False):
    """Return the fit of a lab, and its intervals."""
    force = np.repeat(loads, tests).astype(float)
    per_k = DENSITY * DISTANCE * force / MG
    factors = 1 + scatter * random.standard_normal((len(force), 2))
    losses = per_k[:, None] * TRUE * factors + NOISE * random.standard_normal((len(force), 2))
    observed = np.concatenate(losses.T)
    problem = Problem(
        names=("ball", "disk"),
        observed=observed,
        sigma=np.full(len(observed), NOISE),
        specimen=np.tile(np.arange(len(force)), 2),
        repeatability=scatter if stated or tests == 1 else None,
        lower=np.full(2, -np.inf),
        upper=np.full(2, np.inf),
    )
    found = fit(
        lambda k: np.concatenate([per_k * k[0], per_k * k[1]]), lambda values: problem, TRUE
    )
    return found, [interval(found, axis, LEVEL) for axis in np.eye(2)]


def planned(within, scatter, random):
    """Return how many tests at 100 N are foretold for ± a part, and how many labs need."""
    loss = DENSITY * DISTANCE * 100 * TRUE / MG
    variances = NOISE**2 + (scatter * loss) ** 2
    foretold = int(Search(np.diag(loss**2 / variances)[None], within, LEVEL, True).fewest()[0])
    needed = max(foretold - 3, 2)
    while half_width(needed, scatter, random) > within:
        needed += 1
    return {"within": within, "scatter": scatter, "foretold": foretold, "needed": needed}


def half_width(tests, scatter, random):
    """Return half of the longer interval in the mean over labs, relative to the value."""
    ends = [lab([100], tests, scatter, random)[1] for _ in range(LABS // 10)]
    return float(np.max(np.mean(np.diff(np.exp(ends), axis=-1), axis=0)) / 2)


def main():
    """Simulate the labs, and write the shares covered."""
    random, results = np.random.default_rng(2026), []
    for name, setting in SETTINGS.items():
        began = time.process_time()
        shares = np.mean([covered(**setting, random=random) for _ in range(LABS)], axis=0)
        results.append({"labs": name, "ball": float(shares[0]), "disk": float(shares[1])})
        print(results[-1], f"{time.process_time() - began:.0f} s", flush=True)
    plans = [planned(*each, random) for each in [(0.3, 0.2), (0.2, 0.2), (0.15, 0.2), (0.1, 0.1)]]
    print(plans)
    chance = (binom.ppf([0.025, 0.975], LABS, LEVEL) / LABS).tolist()
    data = {"count": LABS, "level": LEVEL, "by_chance": chance, "results": results, "plans": plans}
    Path(sys.argv[1]).write_text(json.dumps(data, indent=2) + "\n")


if __name__ == "__main__":
    main()
