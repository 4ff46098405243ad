"""From one run to an answer: variants of a case, set side by side, swept, and calibration.

Names are imported when first used, so that the workers of a sweep start fast.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tribo.study.calibration.calibrate import calibrate as calibrate
    from tribo.study.calibration.outcome import Calibration as Calibration
    from tribo.study.comparison import Comparison as Comparison
    from tribo.study.comparison import compare as compare
    from tribo.study.comparison import compare_files as compare_files
    from tribo.study.sweeping.sweep import Sweep as Sweep
    from tribo.study.sweeping.sweep import sweep as sweep
    from tribo.study.variation import Axis as Axis
    from tribo.study.variation import Variant as Variant
    from tribo.study.variation import grid as grid
    from tribo.study.variation import variants as variants

_HOME = {
    "Axis": "tribo.study.variation",
    "Calibration": "tribo.study.calibration.outcome",
    "Comparison": "tribo.study.comparison",
    "Sweep": "tribo.study.sweeping.sweep",
    "Variant": "tribo.study.variation",
    "calibrate": "tribo.study.calibration.calibrate",
    "compare": "tribo.study.comparison",
    "compare_files": "tribo.study.comparison",
    "grid": "tribo.study.variation",
    "sweep": "tribo.study.sweeping.sweep",
    "variants": "tribo.study.variation",
}

__all__ = [*_HOME]


def __getattr__(name: str) -> object:
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    raise AttributeError(f"module 'tribo.study' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(_HOME)
