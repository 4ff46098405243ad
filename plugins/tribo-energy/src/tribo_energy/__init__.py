"""Wear by dissipated energy, and friction traction, for tribo."""
