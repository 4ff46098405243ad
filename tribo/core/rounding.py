"""What is equal but for rounding."""

ROUND_OFF = 1e-9
"""Relative difference that sums of some million floats may make: 1e6 times 2e-16, and a margin of
5."""
