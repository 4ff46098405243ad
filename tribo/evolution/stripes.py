"""Pressures varied from row to row, to find what follows them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from tribo.core.arrays import Array, readonly
from tribo.core.contact import ContactSolution

NUDGE = 1e-4
"""Part of the pressure by which it is varied to find what a wear rate makes of it."""


def in_stripes(
    contacts: Sequence[ContactSolution],
) -> tuple[list[ContactSolution], list[Array]]:
    """Return contacts with pressures varied up and down from row to row, and by how much, in Pa.

    It is the mode that grows first, under the same load.
    """
    stripes = [NUDGE * contact.pressure for contact in contacts]
    for each in stripes:
        each[:, ::2] *= -1
    nudged = [
        replace(contact, pressure=readonly(contact.pressure + each))
        for contact, each in zip(contacts, stripes, strict=True)
    ]
    return nudged, stripes
