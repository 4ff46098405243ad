"""Wear in particles, by which worn surfaces stay rough, for tribo."""
