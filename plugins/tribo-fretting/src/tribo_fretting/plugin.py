"""What this package offers to tribo."""

from __future__ import annotations

from tribo import Component, hookimpl

from tribo_fretting.motion import Fretting
from tribo_fretting.partial_slip import PartialSlip


@hookimpl
def tribo_components() -> tuple[type[Component], ...]:
    """Offer the motion of fretting, and the partial slip that it brings along."""
    return (Fretting, PartialSlip)
