"""What this package offers to tribo."""

from __future__ import annotations

from tribo import Component, ExportFormat, hookimpl

from tribo_topography.export import export_xyz
from tribo_topography.surface import Measured


@hookimpl
def tribo_components() -> tuple[type[Component], ...]:
    """Offer surfaces measured by an instrument."""
    return (Measured,)


@hookimpl
def tribo_export_formats() -> list[ExportFormat]:
    """Offer the worn surfaces as points."""
    return [ExportFormat("xyz", "the worn surfaces as points, in m", export_xyz)]
