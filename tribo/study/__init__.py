"""From one run to an answer: variants of a case side by side, sweeps, and calibration."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tribo.study.calibration.calibrate import calibrate as calibrate
    from tribo.study.calibration.outcome import Calibration as Calibration

_HOME = {
    "Calibration": "tribo.study.calibration.outcome",
    "calibrate": "tribo.study.calibration.calibrate",
}

__all__ = [*_HOME]


def __getattr__(name: str) -> object:
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    raise AttributeError(f"module 'tribo.study' has no attribute {name!r}")
