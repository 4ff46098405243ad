"""The state of the process, which no component may alter."""

from __future__ import annotations

import os
import random
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from tribo.registry.registry import process_kept

_legacy: Any = np.random


def process_state() -> dict[str, Any]:
    """Return the state of the process that a call must not change."""
    return {
        "random": random.getstate(),
        "numpy.random": _legacy.get_state(),
        "numpy.geterr()": np.geterr(),
        "os.getcwd()": os.getcwd(),
        "warnings.filters": [*map(str, warnings.filters)],
        "os.environ": dict(os.environ),
    }


@contextmanager
def process_restored() -> Iterator[None]:
    """Put the process back as it was, whatever is done inside."""
    before = process_state()
    try:
        with process_kept():
            warnings.simplefilter("ignore")
            # A filter of a warning that never comes: another that is put first is seen.
            warnings.filterwarnings("ignore", "a sample of tribo's checks")
            yield
    finally:
        random.setstate(before["random"])
        _legacy.set_state(before["numpy.random"])
        if before["os.environ"] != os.environ:
            os.environ.clear()
            os.environ.update(before["os.environ"])
