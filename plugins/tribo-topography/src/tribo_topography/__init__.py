"""Measured surfaces for tribo, and the roughness of worn ones."""

from tribo.kernel_api import lazy

__getattr__ = lazy(__name__, __file__)
