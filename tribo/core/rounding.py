"""What is equal but for rounding."""

ROUND_OFF = 1e-9
"""Relative difference that sums of some million floats may make."""
