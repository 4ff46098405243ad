"""Operators from pressure to displacement in compiled passes, on threads over the positions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property
from itertools import pairwise
from queue import SimpleQueue
from threading import Thread
from weakref import WeakKeyDictionary, finalize

import numpy as np
from numpy.typing import NDArray
from tribo import CycleCompliance, HalfSpace, Operator, WearCompliance
from tribo.kernel_api import PeriodicHalfSpace, WornOperator

from tribo_fast import passes

Array = NDArray[np.float64]
Modes = NDArray[np.complex128]
Memory = tuple[Modes, Array]
Inbox = SimpleQueue[tuple[Callable[..., None], tuple[object, ...]] | None]
Elastic = HalfSpace | PeriodicHalfSpace
_ROWS = 1 << 12
"""Numbers that a processor's first cache holds: rows are transformed so many at a time."""
_SIDE_BY_SIDE = 16
"""Rows that are transformed at a time at least: a processor takes several side by side."""
_spectra: WeakKeyDictionary[Elastic, Array] = WeakKeyDictionary()


class Threads:
    """Threads that share the positions of a cycle; the caller serves the first part itself."""

    def __init__(self, count: int, positions: int) -> None:
        ends = np.linspace(0, positions, min(count, positions) + 1).astype(int).tolist()
        self.parts = list(pairwise(ends))
        self._inboxes: list[Inbox] = [SimpleQueue() for _ in self.parts[1:]]
        self._done: SimpleQueue[BaseException | None] = SimpleQueue()
        for inbox in self._inboxes:
            Thread(target=_serve, args=(inbox, self._done), daemon=True).start()
            finalize(self, inbox.put, None)

    def __call__(
        self, compiled: Callable[..., None], *given: object, memory: Sequence[Memory] = ()
    ) -> None:
        """Call a pass for the positions of each thread, with memory of the thread's own."""
        own: Sequence[tuple[object, ...]] = memory or [()] * len(self.parts)
        calls = [(*given, *mine, *part) for mine, part in zip(own, self.parts, strict=True)]
        for inbox, call in zip(self._inboxes, calls[1:], strict=True):
            inbox.put((compiled, call))
        compiled(*calls[0])
        for error in [self._done.get() for _ in self._inboxes]:
            if error is not None:
                raise error


def _serve(inbox: Inbox, done: SimpleQueue[BaseException | None]) -> None:
    while (asked := inbox.get()) is not None:
        compiled, call = asked
        try:
            compiled(*call)
        except BaseException as error:
            done.put(error)
        else:
            done.put(None)
        # Not kept until the next call.
        del asked, compiled, call


class Convolution:
    """The spectrum of a convolution on a padded box, and the memory that each thread needs.

    `modes` are complex numbers for each thread, as many as the spectrum has or more.
    """

    def __init__(self, spectrum: Array, padded: tuple[int, int], modes: Sequence[Modes]) -> None:
        self.spectrum = spectrum
        some = max(_SIDE_BY_SIDE, _ROWS // padded[1])
        self.memory: list[Memory] = [
            (mine[: spectrum.size].reshape(spectrum.shape), np.empty((some, padded[1])))
            for mine in modes
        ]


def transposed(spectrum: Array, padded: tuple[int, int]) -> Array:
    """Return a spectrum, transposed, with the factors of both inverse transforms in it."""
    return np.ascontiguousarray(spectrum.T) / (padded[0] * padded[1])


class _Wear:
    """The wear of a step at one position."""

    def __init__(self, wear: WearCompliance, shape: tuple[int, int], dx: float) -> None:
        self._local = np.array(np.broadcast_to(wear.local, shape), dtype=float, order="C")
        self._swept = np.multiply(dx, np.broadcast_to(wear.swept, shape[1:]), dtype=float)

    def add(self, pressure: Array, depth: Array, sums: Array) -> None:
        passes.wear(pressure, depth, sums, self._local, self._swept)


class CompiledCycle(CycleCompliance):
    """The wear of a step that couples positions, taken to surfaces and windows in compiled code."""

    @cached_property
    def _tables(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """First number, rows and columns of each body; where each window begins on it."""
        shapes = np.array([own.shape for own, _ in self.bodies], dtype=np.int64).reshape(-1, 2)
        ends = np.cumsum(shapes.prod(axis=1))
        starts = np.array([cells for _, cells in self.bodies], dtype=np.int64)
        starts = starts.reshape(len(shapes), len(self.shares), 2)
        starts += np.array([self.rows.start, 0])
        first = np.concatenate([[0], ends])[: len(shapes), None]
        return np.hstack([first, shapes]), starts % shapes[:, None]

    def gather(self, fields: Array) -> list[Array]:
        """Return Σₙ ωₙ Tₙᵀ of fields on each body's own surface."""
        bodies, cells = self._tables
        own = np.empty(sum(compliance.size for compliance, _ in self.bodies))
        shares = np.array(self.shares, dtype=float)
        passes.gather(fields, shares, bodies, cells, own, self.mirrored)
        return [own[i : i + nx * ny].reshape(nx, ny) for i, nx, ny in bodies.tolist()]

    def see(self, of_bodies: Sequence[Array], shape: tuple[int, ...]) -> Array:
        """Return the sum of Tₘ of the bodies' fields at each position, of `shape`."""
        seen = np.zeros(shape)
        self.add(of_bodies, seen)
        return seen

    def add(self, of_bodies: Sequence[Array], fields: Array) -> None:
        """Add the sum of Tₘ of the bodies' fields to fields of the window."""
        own = np.concatenate([np.empty(0), *map(np.ravel, of_bodies)])
        passes.scatter(fields, *self._tables, own)


class CompiledOperator:
    """A half-space, with added wear or none, of which positions are on the first axis."""

    def __init__(self, operator: Operator, threads: Threads) -> None:
        base = operator.base if isinstance(operator, WornOperator) else operator
        wear = operator.wear if isinstance(operator, WornOperator) else None
        assert isinstance(base, Elastic)
        self.shape, self.spacing, self.symbol = base.shape, base.spacing, operator.symbol
        self._threads = threads
        if base not in _spectra:
            _spectra[base] = transposed(base.spectrum, base.padded)
        spectrum = _spectra[base]
        self.modes = [np.empty(spectrum.size, dtype=np.complex128) for _ in threads.parts]
        self.elastic = Convolution(spectrum, base.padded, self.modes)
        self.wear: _Wear | CompiledCycle | None = None
        if isinstance(wear, WearCompliance):
            self.wear = _Wear(wear, self.shape, self.spacing[0])
        elif wear is not None:
            self.wear = CompiledCycle(wear.shares, wear.bodies, wear.rows, wear.mirrored)

    def apply(self, pressure: Array) -> Array:
        """Return the displacement under pressures, shape (positions, nx, ny)."""
        displacement, sums = np.empty(pressure.shape), passes.empty_sums(len(pressure))
        by = self.elastic
        self._threads(passes.convolve, pressure, displacement, sums, by.spectrum, memory=by.memory)
        self.add_wear(pressure, displacement, sums)
        return displacement

    def add_wear(self, pressure: Array, displacement: Array, sums: Array) -> None:
        """Add the wear to an elastic displacement, and write the sum of its product with p."""
        if isinstance(self.wear, CompiledCycle):
            worn = zip(self.wear.gather(pressure), self.wear.bodies, strict=True)
            self.wear.add([own * compliance for own, (compliance, _) in worn], displacement)
            passes.multiply(pressure, displacement, sums)
        elif self.wear:
            self.wear.add(pressure, displacement, sums)
