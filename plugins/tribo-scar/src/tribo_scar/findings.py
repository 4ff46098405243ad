"""Faults in the maps of a scar."""

from __future__ import annotations

import warnings

import numpy as np
from tribo import CaseError, Heights, TriboWarning

from tribo_scar.worn_area import WornArea


def warn(words: str) -> None:
    """Warn at the line that measures a scar."""
    warnings.warn(words, TriboWarning, stacklevel=4)


def check_measured(after: Heights) -> None:
    """Refuse a map whose heights are all the same."""
    if np.nanmax(after.heights) == np.nanmin(after.heights):
        raise CaseError(
            f"every height of the map after is {np.nanmax(after.heights):g} m: nothing was "
            "measured; save it again"
        )


def check_scales(before: Heights, after: Heights) -> None:
    """Refuse maps whose numbers of pixels along both axes have a whole ratio above 1."""
    fewer, more = sorted((before.heights.shape, after.heights.shape))
    ratio = more[0] // fewer[0]
    if ratio > 1 and more == tuple(ratio * n for n in fewer):
        raise CaseError(
            f"one map has {ratio} times as many pixels along both axes as the other: if both show "
            "the same area, average the finer one over blocks, or state each pitch in its file; "
            "else cut the larger one"
        )


def warn_of_area(worn: WornArea, *, within: bool) -> None:
    """Warn of a scar that an edge of the map, or `within` it, cuts off, and of several scars."""
    if worn.cut_off:
        edge = "the area common to both maps" if within else "what was measured"
        warn(
            f"the edge of {edge} cuts the scar off: volume and depth belong to the part within, "
            "widths and formulas are left out; measure a larger area"
            f"{', the same before and after' if within else ''}"
        )
    if worn.several:
        warn(
            f"{worn.count} areas are worn: volume is of all, depth is of the deepest, and widths "
            "and formulas are left out; cut the maps to one of them for these"
        )
