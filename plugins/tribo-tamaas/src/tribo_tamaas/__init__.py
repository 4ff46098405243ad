"""tamaas as a contact solver for tribo."""

from tribo_tamaas.solver import Tamaas, TamaasConfig

__all__ = ["Tamaas", "TamaasConfig"]
