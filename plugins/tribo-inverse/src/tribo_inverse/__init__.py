"""From wear to its causes: gradients of a run, and coefficients from measurements."""

from tribo.kernel_api import lazy

__getattr__ = lazy(__name__, __file__)
