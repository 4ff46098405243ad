"""What may be wrong with the input of a fit, where a fit fails or a value is far off."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import pandas as pd
from tribo import Array, CaseError, TriboError
from tribo.kernel_api import OutOfWindow

from tribo_inverse.calibration.experiment import Experiment
from tribo_inverse.calibration.fit import Unsettled
from tribo_inverse.calibration.parameters import Parameter
from tribo_inverse.calibration.quantities import DEPTH_MAP, PROFILES, in_si

SUSPICIOUS = 5.0
"""Factor between measured and computed values from which on it is mentioned if a fit fails."""
REFUSED = 300.0
"""Factor from which on values are refused: a wrong prefix of a unit makes 1000."""


def doubts(experiment: Experiment, error: TriboError) -> Iterator[str]:
    """Return likely reasons of a failed fit."""
    if any(setup.model.case.stop.depth is not None for setup in experiment.setups):
        yield (
            "leave out stop.depth: it ends the run at different times for different coefficients"
        )
    if isinstance(error, OutOfWindow | Unsettled):
        quantities = set(experiment.data["quantity"])
        if DEPTH_MAP in quantities:
            yield "check pitch"
        if quantities & {*PROFILES}:
            yield "check the positions of the profile"


def far_off(data: pd.DataFrame, computed: Array, parameters: Sequence[Parameter]) -> list[str]:
    """Return a sentence for each entry that differs from the first run by a factor above 5.

    CaseError if the factor is above 300, with one line per entry.
    """
    given = ", ".join(f"{p.path} = {in_si(p.start, p.unit)}" for p in parameters)
    sizes = data[["unit", "sigma", "below"]].assign(
        value=data["measured"].abs(), own=np.abs(computed[: len(data)])
    )
    found, refused = [], []
    for place, unit, sigma, below, value, own in (
        sizes.groupby(data["place"], sort=False).max().itertuples()
    ):
        if own == 0:
            continue
        # A value below its uncertainty is only an upper limit.
        factor = own / max(value, sigma)
        if not below:
            factor = max(factor, value / own)
        text = (
            f"{place} was read as {in_si(value, unit)}, and the case gives {in_si(own, unit)} "
            f"with {given}"
        )
        if factor > REFUSED:
            refused.append(
                f"{text}: check the value and its unit, or give a start in fit that is nearer to it"
            )
        elif factor > SUSPICIOUS:
            found.append(text)
    if refused:
        raise CaseError("\n".join(refused))
    return found
