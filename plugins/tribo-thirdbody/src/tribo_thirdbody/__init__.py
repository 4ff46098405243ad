"""Debris between the bodies, a third body, for tribo."""
