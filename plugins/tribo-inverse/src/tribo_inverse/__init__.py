"""From wear to its causes: gradients of a run, and coefficients from what was measured."""

from tribo.kernel_api import lazy

__getattr__ = lazy(__name__, __file__)
