"""Calls into a component: what goes wrong in one names it, and its answers are checked."""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import suppress
from numbers import Number
from typing import Any, Generic, ParamSpec, TypeVar

import numpy as np
from numpy.typing import NDArray

from tribo.component import Component
from tribo.core.arrays import Array
from tribo.core.errors import BadValues, NumericalError, PluginError, TriboError
from tribo.core.words import said
from tribo.guards.trial_time import check_time

REAL = "fiub"
"""Kinds of a dtype that are real numbers."""
NONE = np.empty((0, 0, 0))

C = TypeVar("C", bound=Component)
P = ParamSpec("P")
T = TypeVar("T")


class Guard(Generic[C]):
    """A component, that of a body if it belongs to one; a subclass a kind checks its answers."""

    def __init__(self, component: C, body: str | None = None) -> None:
        self.component = component
        self.body = body

    def __str__(self) -> str:
        """Return what messages call it, as ``wear law 'archard' of body 'ball'``."""
        kind = type(self.component).kind().replace("_", " ")
        words = f"{kind} {self.component.type!r}"
        return f"{words} of body {self.body!r}" if self.body else words

    def ask(self, method: Callable[P, T], *given: P.args, **named: P.kwargs) -> T:
        """Call a method of the component; what nobody expects becomes a `PluginError`."""
        check_time()
        try:
            return method(*given, **named)
        except (KeyboardInterrupt, PluginError):
            raise
        except MemoryError as error:
            raise NumericalError(f"{self} ran out of memory; lower grid.cells") from error
        except BaseException as error:
            if not isinstance(error, TriboError) or not str(error).strip():
                raise PluginError(
                    f"{self} raised {said(error)}; this is a fault of that component "
                    "(TRIBO_DEBUG=1 shows where)"
                ) from error
            if isinstance(error, NumericalError):
                raise NumericalError(f"{self}: {error}") from error
            raise

    def number(self, what: str, value: object) -> float:
        """Return `value`, which is meant to be `what` ("an approach"), as a finite float."""
        if isinstance(value, float | int) and math.isfinite(value):
            return float(value)
        plain = _plain(value)
        if plain.shape != () or not np.isfinite(plain):
            raise BadValues(f"{self} gave {what} that is not a finite number: {_shown(value)}")
        return float(plain)

    def field(
        self,
        what: str,
        values: object,
        shape: tuple[int, ...],
        *,
        spread: bool = False,
        at_least: float = -np.inf,
    ) -> Array:
        """Return `values`, which are meant to be `what`, as finite floats of this shape.

        With `spread` they need only broadcast to it; the array cannot be written to any more.
        """
        plain = values if isinstance(values, np.ndarray) else _plain(values)
        if spread and plain.shape != shape:
            with suppress(ValueError):
                plain = np.broadcast_to(plain, shape)
        if plain.shape != shape or plain.dtype.kind not in REAL:
            raise BadValues(
                f"{self} gave {what} that is not an array of shape {shape}: {_shown(values)}"
            )
        # Sums depend on the order in memory, and a checkpoint keeps but one.
        array = np.asarray(plain, dtype=np.float64, order="C")
        low, high = np.minimum.reduce(array, axis=None), np.maximum.reduce(array, axis=None)
        # Both are NaN if any value is.
        if not -np.inf < low <= high < np.inf:
            bad = np.count_nonzero(~np.isfinite(array))
            raise BadValues(f"{self} gave {what} that is not finite in {bad} cells")
        if low < at_least:
            raise BadValues(f"{self} gave a negative {what.partition(' ')[2]} ({low:.3g})")
        if array.base is not None:
            # What it is a view of could still be written to.
            array = array.copy()
        array.setflags(write=False)
        return array

    def wrong(self, answer: object, instead: str) -> PluginError:
        """Return the error of an answer of the wrong type."""
        return PluginError(f"{self} gave a {type(answer).__name__} {instead}")


def _plain(value: object) -> NDArray[Any]:
    """Return `value` as an array; one of no shape that is asked for where it cannot be one."""
    try:
        array = np.asarray(value)
    except (TypeError, ValueError):
        return NONE
    return array if array.dtype.kind in REAL else NONE


def _shown(value: object) -> str:
    if isinstance(value, np.ndarray):
        return f"{value.dtype} of shape {value.shape}"
    return repr(value) if isinstance(value, Number) else f"a {type(value).__name__}"
