"""Pictures of a result, for print and for notebooks."""

from tribo.plotting.figures import KINDS, Plot, save_figures

__all__ = ["KINDS", "Plot", "save_figures"]
