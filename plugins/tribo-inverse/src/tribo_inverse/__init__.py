"""From wear to its causes: gradients of a run, and coefficients from what was measured."""

from tribo.kernel_api import listed

__all__, __getattr__ = listed(__name__, __file__)
