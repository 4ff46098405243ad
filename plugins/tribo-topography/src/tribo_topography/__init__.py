"""Measured surfaces for tribo."""

from tribo_topography.config import MeasuredFile
from tribo_topography.facts import Facts, describe
from tribo_topography.surface import Measured

__all__ = ["Facts", "Measured", "MeasuredFile", "describe"]
