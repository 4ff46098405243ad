"""What is equal but for rounding."""

ROUND_OFF = 1e-9
"""Relative difference that sums of floats may make: that of 10⁷ operations, and no physics'."""
