"""Intervals by sampling the posterior, with runs of the case itself in place of power laws."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pandas as pd
from scipy.stats import norm
from tribo import Array, CaseError, NumericalError
from tribo.kernel_api import PluginError

from tribo_inverse.calibration.linearised import REPEATABILITY_RANGE, Linearised, root_covariance
from tribo_inverse.calibration.quantities import percent

FEWEST = 100
"""Samples of a chain."""
BURN_IN = 0.25
"""Part of a chain that is discarded, at its beginning."""
WIDE = 1.0
"""Standard deviation of a logarithm beyond which chains start anywhere in the interval."""
IMPOSSIBLE = -1e30
"""Logarithm of the probability where the case cannot be run; finite, as chains may start there."""


def check_sampling(count: int, parameters: int) -> None:
    """Raise CaseError if emcee is not installed, or too few samples are asked for."""
    try:
        import emcee  # noqa: F401
    except ImportError as error:
        raise CaseError(
            "sampling needs emcee, which is not installed: pip install emcee"
        ) from error
    if count < (least := FEWEST * _chains(parameters)):
        raise CaseError(
            f"{count} samples are too few for {parameters} parameter{'s' * (parameters > 1)}: "
            f"give {least} or more"
        )


def sampled(
    model: Callable[[Array], Array],
    fitted: Linearised,
    estimates: pd.DataFrame,
    count: int,
    level: float,
) -> tuple[pd.DataFrame, str]:
    """Return the estimates with the ends of sampled intervals, and a note on them.

    Differential evolution (ter Braak and Vrugt 2008, Stat. Comput. 18, 435-446) by emcee
    (Foreman-Mackey et al. 2013, PASP 125, 306-312). The prior is uniform in each parameter within
    its bounds, and in the logarithm of a repeatability that is not stated. Nothing is sampled where
    an interval is open, as the note then says.
    """
    import emcee

    for each in estimates[np.isinf(estimates["upper"])].itertuples():
        return estimates, (
            f"nothing was sampled, since the data do not bound {each.path} from above: give it an "
            "upper in fit, or leave it out"
        )
    problem, p, chains = fitted.problem, len(estimates), _chains(len(estimates))
    ends, random = np.array([problem.lower, problem.upper]), np.random.default_rng(0)
    root = root_covariance(fitted.sensitivity())
    near = fitted.point + random.standard_normal((chains, p)) @ root.T
    within = np.log(random.uniform(estimates["lower"], estimates["upper"], (chains, p)))
    start = np.where(np.linalg.norm(root, axis=1) > WIDE, within, near)
    # Mirrored, so that no two chains start on a bound.
    start = np.where(start > ends[1], 2 * ends[1] - start, start)
    start = np.where(start < ends[0], 2 * ends[0] - start, start)
    if problem.repeatability is None:
        ends = np.column_stack([ends, np.log(REPEATABILITY_RANGE)])
        about = fitted.repeatability * random.uniform(0.5, 1.5, chains)
        start = np.column_stack([start, np.log(about + REPEATABILITY_RANGE[0])])

    failed = 0
    ended: BaseException | None = None

    def log_probability(place: Array) -> float:
        nonlocal failed, ended
        if ended is not None:
            return IMPOSSIBLE
        if np.any((place < ends[0]) | (place > ends[1])):
            return -np.inf
        point = place[:p]
        scatter = np.exp(place[p]) if problem.repeatability is None else problem.repeatability
        try:
            here = replace(fitted, point=point, responses=model(np.exp(point)))
        except BaseException as error:
            # emcee would print it with the parameters.
            if isinstance(error, CaseError | NumericalError) and not isinstance(error, PluginError):
                failed += 1
            else:
                ended = error
            return IMPOSSIBLE
        here = here.weighed(point, float(scatter))
        return float(np.sum(point)) - 0.5 * here.deviance(point)

    moves = [(emcee.moves.DEMove(), 0.8), (emcee.moves.DESnookerMove(), 0.2)]
    sampler = emcee.EnsembleSampler(*start.shape, log_probability, moves=moves)
    seed = np.random.RandomState(0).get_state()
    begun = emcee.State(np.clip(start, *ends), random_state=seed)
    for _ in sampler.sample(begun, iterations=count // chains):
        if ended is not None:
            raise ended
    discard = int(BURN_IN * count / chains)
    found = np.exp(sampler.get_chain(discard=discard, flat=True)[:, :p])
    part = 0.5 + 0.5 * level
    lower, upper = np.quantile(found, [1 - part, part], axis=0)
    # Of a parameter that only limits of detection tell the interval is one-sided.
    lower = np.where(estimates["limited"], 0.0, lower)
    upper = np.where(estimates["limited"], np.quantile(found, level, axis=0), upper)
    both = estimates.assign(sampled_lower=lower, sampled_upper=upper)
    off = np.maximum(np.abs(lower - both["lower"]), np.abs(upper - both["upper"]))
    difference = float(np.max(off / (both["upper"] - both["lower"])))
    effective = len(found) / float(np.max(sampler.get_autocorr_time(discard=discard, tol=0)))
    far = norm.ppf(part)
    error = np.sqrt(part * (1 - part) / effective) / (2 * far * norm.pdf(far))
    return both, (
        f"ends of sampled intervals lie up to {percent(difference)} % of their lengths from those "
        f"by power laws; {len(found)} samples, as good as {effective:.0f} independent ones, give "
        f"them to about ±{percent(error)} %"
        + (f"; {failed} more could not be run and were left out" if failed else "")
    )


def _chains(parameters: int) -> int:
    return 4 * (parameters + 1)
