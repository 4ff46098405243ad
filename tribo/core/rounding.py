"""What is equal but for rounding, and what is the same."""

ROUND_OFF = 1e-9
"""Relative difference that sums of some million floats may make: 1e6 times 2e-16, and a margin."""
SAME = 1e-6
"""Relative difference of two computations of one thing: beyond `ROUND_OFF`, and too small to be
printed."""
