"""What this package offers to tribo."""

from __future__ import annotations

from pathlib import Path

from tribo import Component, ExportFormat, HeightFormat, Heights, hookimpl

from tribo_topography.config import MeasuredFile
from tribo_topography.export import export_xyz
from tribo_topography.read import read
from tribo_topography.surface import MeasuredSurface


@hookimpl
def tribo_components() -> tuple[type[Component], ...]:
    """Offer surfaces measured by an instrument."""
    return (MeasuredSurface,)


@hookimpl
def tribo_cases() -> tuple[Path, ...]:
    """Offer the validation cases of this package."""
    return (Path(__file__).with_name("cases"),)


@hookimpl
def tribo_export_formats() -> list[ExportFormat]:
    """Offer the worn surfaces as points."""
    return [ExportFormat("xyz", "the worn surfaces as points, in m", export_xyz)]


@hookimpl
def tribo_height_formats() -> list[HeightFormat]:
    """Offer the files of instruments, whose scale is their own."""
    return [HeightFormat("topography", "what SurfaceTopography reads", _heights)]


def _heights(path: Path) -> Heights:
    found = read(MeasuredFile(path=path))
    (sx, sy), (nx, ny) = found.size, found.heights.shape
    return Heights(found.heights, (sx / nx, sy / ny))
