"""Calls into a component: errors name it, and its answers are checked."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import cached_property
from numbers import Number
from typing import Any, Generic, ParamSpec, TypeVar

import numpy as np
from numpy.typing import NDArray

from tribo.component import Component
from tribo.contract import Answer, answers_of
from tribo.core.arrays import Array
from tribo.core.errors import BadValues, NumericalError, PluginError, TriboError
from tribo.core.words import said

REAL = "fiub"
"""Kinds of a dtype that are real numbers."""
NONE = np.empty((0, 0, 0))

C = TypeVar("C", bound=Component)
P = ParamSpec("P")
T = TypeVar("T")


class Guard(Generic[C]):
    """A component, with its body if it has one; a subclass for each kind checks its answers."""

    def __init__(self, component: C, body: str | None = None) -> None:
        self.component = component
        self.body = body

    @cached_property
    def answers(self) -> Mapping[str, Answer]:
        """What the component must answer, by name."""
        return answers_of(self.component)

    def __str__(self) -> str:
        """Return its name in messages, as ``wear law 'archard' of body 'ball'``."""
        kind = type(self.component).kind().replace("_", " ")
        words = f"{kind} {self.component.type!r}"
        return f"{words} of body {self.body!r}" if self.body else words

    def ask(self, method: Callable[P, T], *given: P.args, **named: P.kwargs) -> T:
        """Call a method of the component; unexpected errors become a `PluginError`."""
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

    def number(self, name: str, value: object, where: str = "") -> float:
        """Return the answer `name`, which is a number, as a float."""
        return float(self.array(name, value, (), where))

    def array(self, name: str, values: object, shape: tuple[int, ...], where: str = "") -> Array:
        """Return the answer `name` as floats of this shape, which cannot be written to any more."""
        answer = self.answers[name]
        plain = values if isinstance(values, np.ndarray) else _plain(values)
        if answer.spreads and plain.shape != shape:
            with suppress(ValueError):
                plain = np.broadcast_to(plain, shape)
        if plain.shape != shape or plain.dtype.kind not in REAL:
            raise self.bad(name, _shown(values), where, answer.needed(shape))
        # Sums depend on the order in memory, and a checkpoint keeps but one.
        array = np.asarray(plain, dtype=np.float64, order="C")
        low, high = np.minimum.reduce(array, axis=None), np.maximum.reduce(array, axis=None)
        least, most = answer.range
        # Both are NaN if any value is.
        if not least <= low <= high <= most:
            bad = np.count_nonzero(~np.isfinite(array))
            worst = low if low < least else high
            fault = f"not finite in {bad} cells" if bad else f"{worst:.6g} somewhere"
            raise self.bad(name, fault if shape else f"{array!s:.24}", where)
        if array.base is not None:
            # What it is a view of could still be written to.
            array = array.copy()
        array.setflags(write=False)
        return array

    def bad(self, name: str, fault: str, where: str = "", needed: str = "") -> BadValues:
        """Return the error of the answer `name`, with the fault and what is `needed`.

        By default what its declaration allows is needed.
        """
        needed = needed or self.answers[name].needed()
        return BadValues(f"{self} gave {name!r}{where} that is {fault}; {needed}")

    def typed(self, answer: object, kind: type, method: str) -> Any:
        """Return an answer, which is meant to be `method` ("its rate"), if it is of a class."""
        if not isinstance(answer, kind):
            given, needed = type(answer).__name__, kind.__name__
            raise PluginError(f"{self} gave a {given} as {method}; it must be a {needed}")
        return answer


def _plain(value: object) -> NDArray[Any]:
    """Return `value` as an array; an array of a wrong shape where it cannot be converted."""
    try:
        array = np.asarray(value)
    except (TypeError, ValueError):
        return NONE
    return array if array.dtype.kind in REAL else NONE


def _shown(value: object) -> str:
    if isinstance(value, np.ndarray):
        return f"{value.dtype} of shape {value.shape}"
    return repr(value) if isinstance(value, Number) else f"a {type(value).__name__}"
