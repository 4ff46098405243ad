"""Measured values that cannot be right, and how exactly they were measured."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from tribo import Array, CaseError
from tribo.kernel_api import number

from tribo_inverse.calibration.quantities import FIELDS, in_si, in_words

if TYPE_CHECKING:
    from tribo_inverse.calibration.parameters import Parameter

LEAST_UNCERTAINTY = 1e-6
"""Smallest relative uncertainty."""
REFUSED = 300.0
"""Factor between measured and computed values from which on they are refused: a wrong prefix of a
unit makes 1000."""
_SIGNIFICANT = 3.0
"""Standard deviations by which a mean depth below 0 is not noise."""


class Share(float):
    """An uncertainty as a part of each value, as ``"5 %"``."""


def part_of(text: str, quantity: str) -> Share:
    """Return the part of a value that a text in per cent says; CaseError if it cannot be one."""
    if quantity in FIELDS:
        raise CaseError(f"{text!r}: of depths at many places give it with a unit, as '10 nm'")
    try:
        part = number(text[:-1]) / 100
    except ValueError:
        raise CaseError(f"{text!r} is no number of per cent; write '5 %'") from None
    if not 0 < part < 1:
        raise CaseError(f"{text!r}: an uncertainty is above 0 % and below 100 %")
    return Share(part)


def data_error(quantity: str, sigma: Array | float, values: Array) -> str:
    """Return why values cannot be right: in another unit, or depths negative; else empty."""
    each = np.broadcast_to(sigma, values.shape)
    if np.any(exact := each < LEAST_UNCERTAINTY * np.abs(values)):
        worst = int(np.argmax(exact * np.abs(values)))
        return (
            f"known to {in_words(quantity, float(each[worst]))}, less than a millionth of "
            f"{in_words(quantity, float(values[worst]))}: no run is that exact; check the "
            "uncertainty, and the units of both"
        )
    mean = float(np.mean(values))
    if not mean < -_SIGNIFICANT * np.max(each) / np.sqrt(len(values)):
        return ""
    return (
        f"the depths are negative, {1e6 * mean:.3g} µm in the mean; depths count downwards from "
        "the unworn surface, positive where it is worn: turn the sign round, or level them"
    )


def check_sizes(data: pd.DataFrame, computed: Array, parameters: Sequence[Parameter]) -> None:
    """Refuse entries that differ from the first run by a factor above 300, with a line for each."""
    given = ", ".join(f"{p.path} = {in_si(p.start, p.unit)}" for p in parameters)
    sizes = data[["unit", "sigma", "below"]].assign(
        value=data["measured"].abs(), own=np.abs(computed[: len(data)])
    )
    refused = [
        f"{place} was read as {in_si(value, unit)}, and the case gives {in_si(own, unit)} with "
        f"{given}: check the value and its unit, or give a start in fit that is nearer to it"
        for place, unit, sigma, below, value, own in (
            sizes.groupby(data["place"], sort=False).max().itertuples()
        )
        # A value below its uncertainty is only an upper limit.
        if own > REFUSED * max(value, sigma) or (value > REFUSED * own > 0 and not below)
    ]
    if refused:
        raise CaseError("\n".join(refused))
