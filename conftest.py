"""Settings of every test: one thread, no waiting for a disk, and a strict `pytest.approx`."""

import os

# Set before NumPy is imported. On small matrices more threads mostly wait for each other.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
import pytest

# Tests of crashes read the recorded calls, so that no test needs the disk to be synchronised.
os.fsync = lambda file: None

_approx = pytest.approx


def approx(expected, rel=None, abs=None, nan_ok=False):
    """`pytest.approx`, but an error where its default abs=1e-12, not `rel`, would decide."""
    if abs is None:
        values = list(expected.values()) if isinstance(expected, dict) else expected
        allowed = (1e-6 if rel is None else rel) * np.abs(np.asarray(values, float))
        if (allowed < 1e-12).any():
            raise ValueError(
                f"approx({expected!r}) allows 1e-12; give rel with abs=0, or abs alone"
            )
    return _approx(expected, rel, abs, nan_ok)


pytest.approx = approx
