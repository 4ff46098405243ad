"""Measured surfaces for tribo."""

from tribo_topography.config import MeasuredFile
from tribo_topography.facts import Facts, describe
from tribo_topography.surface import MeasuredSurface

__all__ = ["Facts", "MeasuredFile", "MeasuredSurface", "describe"]
