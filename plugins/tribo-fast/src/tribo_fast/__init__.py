"""Contact solves of tribo in compiled code."""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from functools import cache
from importlib import metadata
from threading import Timer
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from tribo import Operator

    from tribo_fast.iterate import CompiledIterate

_PACKAGES = ("tribo-fast", "numba", "rocket-fft")
FEWEST = 1 << 12
"""Cells of all positions from which on a solve is compiled: 100 smaller solves gain less than the
0.4 s that loading the compiled code takes."""
_PATIENCE = 2.0
"""Seconds after which a line states what takes so long: loading takes less, compiling more."""


def iterates(operator: Operator, cells: int) -> type[CompiledIterate] | None:
    """Return what iterates in compiled code on so many cells; None where NumPy does."""
    if cells < FEWEST or not threads():
        return None
    module, reason = _loaded()
    if module is None:
        _warn_once(reason)
        return None
    return module.CompiledIterate if module.serves(operator) else None


def versions() -> dict[str, str]:
    """Return the versions that a result states: of what is installed, unless it is turned off."""
    found: dict[str, str] = {}
    for name in _PACKAGES if threads() else ():
        with suppress(metadata.PackageNotFoundError):
            found[name] = metadata.version(name)
    return found


def check() -> tuple[str, bool, str]:
    """Return a line of `tribo doctor`: whether compiled code loads, and its error beside NumPy."""
    name = "compiled contact solves"
    if not threads():
        return name, True, "turned off by TRIBO_FAST=0"
    module, detail = _loaded()
    return name, module is not None, detail


def threads() -> int:
    """Return how many threads may share the positions of a cycle; 0 turns compiled code off."""
    wanted = os.environ.get("TRIBO_FAST", "")
    if not wanted:
        from scipy.fft import get_workers

        return int(get_workers())
    if not wanted.isdecimal():
        from tribo import CaseError

        raise CaseError(
            f"TRIBO_FAST is {wanted!r}; it must be a number of threads, or 0 to turn tribo-fast off"
        )
    return int(wanted)


@cache
def _loaded() -> tuple[Any, str]:
    """Return the compiled iteration and how exact it is, or None and why there is none."""
    words = "tribo-fast compiles its code for this processor, once; that takes about 10 s"
    waiting = Timer(_PATIENCE, lambda: print(words, file=sys.stderr, flush=True))
    waiting.start()
    try:
        from tribo_fast import iterate

        return iterate, f"off by {iterate.tried():.0e}"
    except Exception as error:  # Whatever a compiler stack raises that is not whole.
        first, *_ = str(error).splitlines() or [""]
        return None, f"{type(error).__name__}: {first}"
    finally:
        waiting.cancel()


@cache
def _warn_once(reason: str) -> None:
    from tribo.kernel_api import warn

    warn(
        f"tribo-fast is installed but does not load: {reason}; contact solves use NumPy. Reinstall "
        "numba and rocket-fft, name a new folder for compiled code in NUMBA_CACHE_DIR, or turn "
        "tribo-fast off by TRIBO_FAST=0"
    )
