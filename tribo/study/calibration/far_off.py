"""Measured values that are far from what the case gives, as one without its unit is."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from tribo.core.arrays import Array
from tribo.core.errors import CaseError, TriboWarning
from tribo.study.calibration.measured import Measured
from tribo.study.calibration.parameters import Parameter
from tribo.study.calibration.quantities import in_si, unit_of

NOTABLE, FAR, TOO_FAR = 5.0, 100.0, 300.0
"""Factors between measured and computed: may be why a run fails, is told, is refused.

A prefix is a factor of 1000; a start may be off by a few on top of it.
"""


@dataclass(frozen=True)
class FarOff:
    """A measured value beside what the case gives: how many times it is off, and both in words."""

    factor: float
    text: str


def check_far_off(found: Sequence[FarOff]) -> None:
    """Refuse what is too far off to be fitted, and tell of what is far off.

    Raises
    ------
    CaseError
        If a measured value is off by more than 300 times; one line a value.
    """
    refused = [each.text for each in found if each.factor > TOO_FAR]
    if refused:
        raise CaseError(
            "\n".join(
                f"{text}: check the value and its unit, or give a start in fit that is nearer to it"
                for text in refused
            )
        )
    for each in found:
        if each.factor > FAR:
            warnings.warn(
                f"{each.text}: is that the value, and the unit, that was meant?",
                TriboWarning,
                stacklevel=2,
            )


def far_off(
    measured: Sequence[Measured], computed: Array, parameters: Sequence[Parameter]
) -> Iterator[FarOff]:
    """Yield what is measured several times above or below what the first run gives.

    Parameters
    ----------
    measured : sequence of Measured
        What was measured.
    computed : ndarray, shape (n,)
        The data as that run gives them, in the same order.
    parameters : sequence of Parameter
        What it was made with.
    """
    values = iter(computed.tolist())
    given = ", ".join(f"{p.path} = {in_si(p.start, p.unit)}" for p in parameters)
    for i, entry in enumerate(measured):
        own = max(abs(next(values)) for _ in entry.values)
        read = float(np.max(np.abs(entry.values)))
        if own == 0 or read == 0:
            continue
        side, ratio = ("above", read / own) if read > own else ("below", own / read)
        # Of less than its uncertainty, as a null result, no more is known than that it is as small.
        factor = ratio if read > own else own / max(read, entry.sigma)
        if factor <= NOTABLE:
            continue
        unit = unit_of(entry.quantity)
        reading = "before less after" if entry.value is None else "value"
        rounded = float(f"{ratio:.3g}")
        yield FarOff(
            factor,
            f"measured[{i}]: {reading} was read as {in_si(read, unit)}, a factor of {rounded:g} "
            f"{side} the {in_si(own, unit)} that the case gives with {given}",
        )
