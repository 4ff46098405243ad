"""From one run to an answer: variants of a case, set side by side, and calibration."""

from tribo.study.calibration.calibrate import calibrate
from tribo.study.calibration.outcome import Calibration
from tribo.study.comparison import Comparison, compare, compare_files
from tribo.study.variation import Axis, Variant, grid, variants

__all__ = [
    "Axis",
    "Calibration",
    "Comparison",
    "Variant",
    "calibrate",
    "compare",
    "compare_files",
    "grid",
    "variants",
]
