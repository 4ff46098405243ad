"""What a fresh Python imports."""

import subprocess
import sys

import pytest

HEAVY = (
    *("scipy.fft", "scipy.interpolate", "scipy.linalg", "scipy.ndimage"),
    *("scipy.optimize", "scipy.sparse", "scipy.special", "scipy.stats"),
    *("h5py", "matplotlib", "numpy.testing", "pandas", "psutil", "rich", "xarray"),
)
"""Modules that take long to import."""


@pytest.mark.parametrize("names", ["Simulation, load_case", "WearLaw, Quantity"])
def test_names_of_tribo_are_imported_without_heavy_modules(tmp_path, names):
    code = f"import sys; from tribo import {names}; print(*{{*sys.modules}} & {{*{HEAVY}}})"
    assert subprocess.check_output([sys.executable, "-c", code], cwd=tmp_path, text=True) == "\n"
