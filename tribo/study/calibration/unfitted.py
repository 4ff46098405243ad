"""Which wear coefficient that is not fitted would explain a misfit."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from tribo.core.errors import CaseError, NumericalError
from tribo.study.calibration.experiment import Experiment
from tribo.study.calibration.linearised import Linearised
from tribo.study.calibration.parameters import find_parameters

STEP = 1.2
"""Factor on a coefficient between two runs."""
EXPLAINED = 0.5
"""Part of the excess of χ² that it must explain."""


def unfitted(fitted: Linearised, experiment: Experiment, freedom: int) -> Iterator[str]:
    """Name the coefficient by which χ² would fall most, if that is half of what is too much.

    By the score test (Rao 1948), with one run for each body whose coefficient is not fitted.
    """
    rows = ~fitted.problem.below
    residuals, values = fitted.residuals(fitted.point), np.exp(fitted.point)
    chi_square = float(np.sum(residuals[rows] ** 2))
    basis = np.linalg.qr(fitted.sensitivity()[rows])[0]
    cases = [setup.model.case for setup in experiment.setups]
    falls = {}
    for name in cases[0].bodies:
        try:
            more, *others = {find_parameters(case, [], [name])[0] for case in cases}
            if others or more.path in fitted.problem.names:
                # The tests have their own, or it is fitted.
                continue
            wider = replace(experiment, parameters=[*experiment.parameters, more], runs={})
            responses = wider.run(np.append(values, STEP * more.start)).responses
        except (CaseError, NumericalError):
            # It has no coefficient above 0, or cannot be run: the fit stands without a reason.
            continue
        moved = fitted.problem.residuals(responses, fitted.weights)
        effect = ((moved - residuals) / math.log(STEP))[rows]
        effect -= basis @ (basis.T @ effect)
        if (size := float(np.sum(effect**2))) > 0:
            falls[more.path] = float(np.sum(effect * residuals[rows])) ** 2 / size
    path = max(falls, key=falls.__getitem__, default="")
    if path and falls[path] > EXPLAINED * (chi_square - freedom):
        yield (
            f"{path} is not fitted, and may be wrong in the case: fitting it too would lower χ² "
            f"from {chi_square:.3g} to about {max(chi_square - falls[path], 0):.2g}"
        )
