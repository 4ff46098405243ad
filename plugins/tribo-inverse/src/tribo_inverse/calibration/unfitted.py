"""Numbers of a case that are not fitted and would explain a misfit."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from tribo import CaseError, NumericalError
from tribo.kernel_api import path_keys, unusual

from tribo_inverse.calibration.experiment import Experiment
from tribo_inverse.calibration.fit import STEP
from tribo_inverse.calibration.linearised import Linearised
from tribo_inverse.calibration.measured import FitEntry
from tribo_inverse.calibration.parameters import Parameter, find_parameters
from tribo_inverse.calibration.quantities import in_si

EXPLAINED = 0.9
"""Part of the excess of χ² that a number must explain."""
ALIKE = 6.0
"""Difference of χ² below which numbers explain the data alike."""


def explanations(fitted: Linearised, experiment: Experiment, freedom: int) -> tuple[int, str]:
    """Return the runs made, and sentences on the numbers that would explain a misfit if fitted.

    One run for each number; the estimates are those of the model linearised about the fit.
    """
    rows = ~fitted.problem.below
    excess = float(np.sum(fitted.residuals(fitted.point)[rows] ** 2)) - freedom
    found, runs = [], 0
    for candidate in _candidates(experiment):
        more = replace(experiment, parameters=[*experiment.parameters, candidate], runs={})
        point = np.append(fitted.point, np.log(candidate.start))
        moved = np.exp(point + STEP * (np.arange(len(point)) == len(point) - 1))
        try:
            change = fitted.problem.scaled(more.run(moved).responses)
        except (CaseError, NumericalError):
            continue
        runs += more.run_count
        slopes = (change - fitted.problem.scaled(fitted.responses)) / STEP
        problem = replace(
            fitted.problem,
            lower=np.append(fitted.problem.lower, -np.inf),
            upper=np.append(fitted.problem.upper, np.log(candidate.upper)),
        )
        both = replace(fitted, problem=problem, point=point, slopes=np.c_[fitted.slopes, slopes])
        best = both.least(point)
        left, value = float(np.sum(both.residuals(best)[rows] ** 2)), float(np.exp(best[-1]))
        if left - freedom < (1 - EXPLAINED) * excess:
            found.append((left, candidate, value))
    return runs, "".join(
        f"Fitting {candidate.path} too would lower χ² to about {round(left, 3):.3g}, with "
        f"{in_si(value, candidate.unit, 2)} or so instead of "
        f"{in_si(candidate.start, candidate.unit)}. "
        for left, candidate, value in sorted(found, key=lambda each: each[0])
        if left < min(each[0] for each in found) + ALIKE
    )


def odd_numbers(experiment: Experiment) -> list[str]:
    """Return questions about numbers that are not fitted and look as if a unit was forgotten."""
    paths = [".".join(path_keys(each.path)) for each in experiment.parameters]
    fitted = tuple(f"{path}{end}" for path in paths for end in " ,")
    # Alike in the cases of several tests.
    every = dict.fromkeys(each for setup in experiment.setups for each in unusual(setup.model.case))
    return [each for each in every if not each.startswith(fitted)]


def _candidates(experiment: Experiment) -> Iterator[Parameter]:
    """Return coefficients, load, radii and densities, unless fitted or different between tests."""
    cases = [setup.model.case for setup in experiment.setups]
    names, of_bodies = cases[0].bodies, ("wear.k", "surface.radius")
    paths = [f"bodies.{name}.{number}" for name in names for number in of_bodies]
    weighed = experiment.data.loc[experiment.data["quantity"] == "mass", "body"].unique()
    paths += [*(f"bodies.{name}.material.density" for name in weighed), "load.normal"]
    for path in paths:
        if path in (each.path for each in experiment.parameters):
            continue
        try:
            numbers = {find_parameters(case, [FitEntry(path=path)], ())[0] for case in cases}
        except CaseError:
            # There is no such number, or it is 0.
            continue
        if len(numbers) == 1:
            yield numbers.pop()
