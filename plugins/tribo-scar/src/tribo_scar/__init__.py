"""Scars from height maps of a body before and after a test."""

from tribo.kernel_api import lazy

__getattr__ = lazy(__name__, __file__)
