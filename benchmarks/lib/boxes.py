"""Which boxes tribo transforms, seen from outside."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any
from unittest.mock import patch

import numpy as np
import scipy.fft

from tribo import Array
from tribo.contact.dcfft import DcFft
from tribo.contact.padded_half_space import HalfSpace

Shape = tuple[int, int]


def traced(action: Callable[[], object]) -> list[list[Shape]]:
    """Run `action`; return for each contact solve the boxes its operator was applied on."""
    solves: list[list[Shape]] = []
    apply, solve = HalfSpace.apply, DcFft.solve

    def applied(operator: HalfSpace, *arguments: Any, **options: Any) -> Any:
        if solves:
            solves[-1].append(operator.shape)
        return apply(operator, *arguments, **options)

    def solved(solver: DcFft, *arguments: Any, **options: Any) -> Any:
        solves.append([])
        return solve(solver, *arguments, **options)

    with patch.object(HalfSpace, "apply", applied), patch.object(DcFft, "solve", solved):
        action()
    return solves


def own_box(boxes: list[Shape]) -> Shape:
    """Return the box a solve is about: the largest it was on."""
    return max(boxes, key=lambda shape: shape[0] * shape[1])


def padded(box: Shape) -> Shape:
    """Return the size that keeps a convolution on `box` from wrapping around."""
    nx, ny = (scipy.fft.next_fast_len(2 * n - 1, real=True) for n in box)
    return nx, ny


def round_trip(box: Shape) -> Callable[[], Array]:
    """Return what no solve can avoid: a padded transform there and back, on one core."""
    values = np.zeros(padded(box))
    values[: box[0], : box[1]] = 1.0

    def trip() -> Array:
        back: Array = scipy.fft.irfft2(scipy.fft.rfft2(values, workers=1), values.shape, workers=1)
        return back

    return trip
