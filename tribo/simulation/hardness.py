"""Who yields, and at which pressure: the hardness of the bodies and of their layers."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import zip_longest

import numpy as np

from tribo.case import Body
from tribo.contact.solver import ContactSolver
from tribo.core.errors import CaseError


def yielding(
    bodies: Mapping[str, Body], contact: ContactSolver
) -> tuple[float | None, dict[str, float], dict[str, tuple[float, ...]]]:
    """Return the largest pressure at first, in Pa, who yields, and hardnesses that change.

    Where a layer has a hardness of its own, each body yields where it is the softer one; elsewhere
    it takes its part of what yields.
    """
    found = {
        name: tuple(material.hardness or np.inf for material in body.materials())
        for name, body in bodies.items()
    }
    # Below layers without a hardness another may be the first that limits.
    softest = map(min, zip_longest(*found.values(), fillvalue=np.inf))
    cap = next(filter(np.isfinite, softest), None)
    if cap is None or not contact.plasticity:
        return None, dict.fromkeys(bodies, 0.0), {}
    if not contact.honours_cap:
        raise CaseError(
            f"contact.type = {contact.type!r} cannot limit the pressure to a hardness; "
            "set contact.plasticity = false, or leave hardness out",
            "contact.plasticity",
        )
    changing = [name for name, each in found.items() if len(set(each)) > 1]
    if changing and not contact.takes_cap_map:
        raise CaseError(
            f"contact.type = {contact.type!r} limits the pressure to one hardness throughout; "
            "set contact.plasticity = false where layers have one of their own, or take "
            "'dcfft' or 'periodic'",
            f"bodies.{changing[0]}.layers",
        )
    if changing:
        return cap, {name: float(np.isfinite(min(each))) for name, each in found.items()}, found
    soft = [name for name, each in found.items() if each[0] == cap]
    return cap, {name: (name in soft) / len(soft) for name in bodies}, {}
