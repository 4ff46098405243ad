"""tamaas as a contact solver for tribo."""

from tribo_tamaas.solver import Tamaas

__all__ = ["Tamaas"]
