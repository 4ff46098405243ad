"""tribo and its peers, driven alike: set up for a window, then asked for pressures."""

from __future__ import annotations

import atexit
import json
import os
import subprocess
import warnings
from abc import ABC, abstractmethod
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from benchmarks.lib.common import SLIPPY, cpu_time
from benchmarks.lib.problems import MODULUS, Contact, Verdict, judge, rough
from tribo import Array, ContactProblem, ContactSolution, ContactSystem, Grid
from tribo.registry.registry import default_registry

MOST_ITERATIONS = 20000
LOOSEST = 1e-4


@contextmanager
def compiled(threads: int) -> Iterator[None]:
    """Let tribo-fast, where it is installed, use so many threads; with 0 NumPy solves."""
    before = os.environ.get("TRIBO_FAST", "")
    os.environ["TRIBO_FAST"] = str(threads)
    try:
        yield
    finally:
        os.environ["TRIBO_FAST"] = before


@dataclass(frozen=True)
class Answer:
    """A pressure, the iterations it took where the package tells, and what it starts from."""

    pressure: Array
    iterations: int | None
    raw: Any


class Package(ABC):
    """A package set up for the window of `contact`, to be asked to `tolerance` of its own."""

    name: ClassVar[str]
    module: ClassVar[str]
    """What must be installed."""

    def __init__(self, contact: Contact, tolerance: float) -> None:
        self.contact = contact
        self.tolerance = tolerance

    @classmethod
    def present(cls) -> bool:
        """Whether the package is installed."""
        return find_spec(cls.module) is not None

    @classmethod
    def solves(cls, contact: Contact) -> bool:
        """Whether the package has a solver for such a contact."""
        return True

    @property
    def process(self) -> int:
        """Number of the process that solves."""
        return os.getpid()

    @abstractmethod
    def solve(self, gap: Array, start: Answer | None = None) -> Answer:
        """Return the pressure for `gap`, from an earlier answer of this object or from nothing."""


class Tribo(Package):
    """tribo's `dcfft`, or `periodic`, with NumPy."""

    name = "tribo"
    module = "tribo"
    threads: ClassVar[int] = 0

    def __init__(self, contact: Contact, tolerance: float) -> None:
        super().__init__(contact, tolerance)
        cls = default_registry().lookup(
            "contact_solver", "periodic" if contact.periodic else "dcfft"
        )
        self.solver: Any = cls(tolerance=tolerance)
        grid = Grid((contact.width, contact.width), contact.gap.shape)
        self.system = ContactSystem(grid, MODULUS, contact.load, contact.cap)

    def solve(self, gap: Array, start: Answer | None = None) -> Answer:
        """Return the pressure; see `Package.solve`."""
        problem = ContactProblem(self.system, gap, self.contact.load)
        with compiled(self.threads):
            found: ContactSolution = self.solver.solve(problem, start and start.raw)
        return Answer(found.pressure, found.iterations, found)


class TriboFast(Tribo):
    """tribo with tribo-fast, on one thread."""

    name = "tribo, compiled"
    module = "tribo_fast"
    threads = 1

    @classmethod
    @cache
    def present(cls) -> bool:
        """Whether tribo-fast is installed; its code is loaded, so that no timed solve loads it."""
        if not super().present():
            return False
        contact = rough(256)
        cls(contact, LOOSEST).solve(contact.gap)
        return True


class Aspher(Package):
    """ASPHER on its one grid: Polonsky and Keer with its preconditioner; periodic windows only."""

    name = "ASPHER, flat"
    module = "aspher"

    def __init__(self, contact: Contact, tolerance: float) -> None:
        super().__init__(contact, tolerance)
        self.solver: Any = import_module("aspher").ContactSolver(
            len(contact.gap), backend="periodic"
        )

    @classmethod
    def solves(cls, contact: Contact) -> bool:
        """Whether the window repeats and pressures have no cap."""
        return contact.periodic and contact.cap is None

    def solve(self, gap: Array, start: Answer | None = None) -> Answer:
        """Return the pressure; see `Package.solve`."""
        found = self.solver.solve(
            gap / self.contact.width,
            self.contact.mean_pressure / MODULUS,
            tol=self.tolerance,
            max_iter=MOST_ITERATIONS,
            precond="fourier",
            p_init=None if start is None else start.pressure / MODULUS,
        )
        return _answer_of_aspher(found, gap)


class AspherNested(Package):
    """ASPHER from 64² cells on, doubled up to the window; it cannot start from an answer."""

    name = "ASPHER, nested"
    module = "aspher"

    @classmethod
    def solves(cls, contact: Contact) -> bool:
        """Whether ASPHER does, and the window is 64 times a power of two."""
        doublings = np.log2(len(contact.gap) / 64)
        return Aspher.solves(contact) and doublings >= 0 and doublings.is_integer()

    def solve(self, gap: Array, start: Answer | None = None) -> Answer:
        """Return the pressure; see `Package.solve`."""
        found = import_module("aspher").solve_nested(
            grid_size=len(gap),
            gap=gap / self.contact.width,
            p_nominal=self.contact.mean_pressure / MODULUS,
            backend="periodic",
            tol=self.tolerance,
        )
        return _answer_of_aspher(found, gap)


def _answer_of_aspher(found: Any, gap: Array) -> Answer:
    pressure = np.asarray(found.pressure).reshape(gap.shape) * MODULUS
    return Answer(pressure, int(found.iterations), None)


class Tamaas(Package):
    """tamaas: Polonsky and Keer with Rey's projection; Kato's solver under a cap.

    It gets E* = 1 and a window eight wide: Kato's steps are of one length in the
    caller's units.
    """

    name = "tamaas"
    module = "tamaas"
    side: ClassVar[float] = 8.0

    def __init__(self, contact: Contact, tolerance: float) -> None:
        super().__init__(contact, tolerance)
        tamaas = import_module("tamaas")
        tamaas.set_log_level(tamaas.LogLevel.error)
        shape = list(contact.gap.shape)
        self.scale = self.side / contact.width
        self.model = tamaas.ModelFactory.createModel(
            tamaas.model_type.basic_2d, [self.side, self.side], shape
        )
        self.model.E, self.model.nu = 1.0, 0.0
        self.heights = np.zeros(shape)
        if contact.cap is None:
            self.solver = tamaas.PolonskyKeerRey(self.model, self.heights, tolerance)
        else:
            cap = contact.cap / MODULUS
            self.solver = tamaas.KatoSaturated(self.model, self.heights, tolerance, cap)
        if not contact.periodic:
            tamaas.ModelFactory.registerNonPeriodic(self.model, "dcfft")
            self.solver.setIntegralOperator("dcfft")
        self.solver.max_iter = MOST_ITERATIONS

    def solve(self, gap: Array, start: Answer | None = None) -> Answer:
        """Return the pressure; see `Package.solve`."""
        # The solver looks at this array and at the model's traction.
        np.multiply(gap, -self.scale, out=self.heights)
        traction = self.model.traction.reshape(gap.shape)
        traction[:] = 0.0 if start is None else start.pressure / MODULUS
        self.solver.solve(self.contact.mean_pressure / MODULUS)
        return Answer(np.maximum(traction, 0.0) * MODULUS, None, None)


class ContactMechanics(Package):
    """ContactMechanics: Polonsky and Keer."""

    name = "ContactMechanics"
    module = "ContactMechanics"

    def __init__(self, contact: Contact, tolerance: float) -> None:
        super().__init__(contact, tolerance)
        with warnings.catch_warnings(action="ignore"):
            package = import_module("ContactMechanics")
            self.factory = import_module("ContactMechanics.Factory")
            self.surfaces = import_module("SurfaceTopography")
        kind = "PeriodicFFT" if contact.periodic else "FreeFFT"
        self.substrate = getattr(package, f"{kind}ElasticHalfSpace")(
            contact.gap.shape, MODULUS, (contact.width, contact.width)
        )

    def solve(self, gap: Array, start: Answer | None = None) -> Answer:
        """Return the pressure; see `Package.solve`."""
        contact, area = self.contact, self.contact.spacing**2
        surface = self.surfaces.Topography(
            -gap, physical_sizes=(contact.width, contact.width), periodic=contact.periodic
        )
        if contact.cap is None:
            make = self.factory.make_system
        else:
            make = self.factory.make_plastic_system
            surface = self.surfaces.PlasticTopography(surface, hardness=contact.cap)
        forces = {}
        if start is not None:
            forces["initial_forces"] = np.zeros(self.substrate.nb_subdomain_grid_pts)
            forces["initial_forces"][: gap.shape[0], : gap.shape[1]] = -area * start.pressure
        found = make(substrate=self.substrate, surface=surface).minimize_proxy(
            external_force=contact.load,
            pentol=self.tolerance * contact.depth,
            thermotol=self.tolerance,
            forcetol=self.tolerance * contact.pressure * area,
            maxiter=MOST_ITERATIONS,
            **forces,
        )
        return Answer(np.asarray(found.jac) / area, int(found.nit), None)


class Slippy(Package):
    """slippy: Polonsky and Keer, in a process of its own, which runs Python 3.9.

    It gets E* = 1 and a window of unit edge: its first pressure has the load for a mean.
    """

    name = "slippy"

    @classmethod
    def present(cls) -> bool:
        """Whether its interpreter is named."""
        return SLIPPY in os.environ

    @classmethod
    def solves(cls, contact: Contact) -> bool:
        """Whether pressures have no cap."""
        return contact.cap is None

    @property
    def process(self) -> int:
        """Number of the process that solves."""
        return _slippy().pid

    def solve(self, gap: Array, start: Answer | None = None) -> Answer:
        """Return the pressure; see `Package.solve`."""
        mean = self.contact.mean_pressure / MODULUS
        guess = np.ones_like(gap) if start is None else start.pressure
        request = {
            "cells": len(gap),
            "periodic": self.contact.periodic,
            "mean": mean,
            "tolerance": self.tolerance,
            "most": MOST_ITERATIONS,
        }
        worker = _slippy()
        assert worker.stdin is not None
        assert worker.stdout is not None
        worker.stdin.write(json.dumps(request).encode() + b"\n")
        worker.stdin.write((gap / self.contact.width).tobytes() + guess.tobytes())
        worker.stdin.flush()
        reply = json.loads(worker.stdout.readline())
        pressure = np.frombuffer(worker.stdout.read(gap.nbytes)).reshape(gap.shape)
        cpu_time.elsewhere += reply["seconds"]
        return Answer(pressure * MODULUS, reply["iterations"], None)


@cache
def _slippy() -> subprocess.Popen[bytes]:
    """Return the process that solves with slippy; it ends with this one."""
    script = Path(__file__).with_name("slippy_solves.py")
    pipe = subprocess.PIPE
    worker = subprocess.Popen([os.environ[SLIPPY], str(script)], stdin=pipe, stdout=pipe)
    atexit.register(worker.communicate)
    return worker


EVERY: tuple[type[Package], ...] = (
    Tribo,
    TriboFast,
    AspherNested,
    Aspher,
    Tamaas,
    ContactMechanics,
    Slippy,
)


def packages(contact: Contact) -> list[type[Package]]:
    """Return tribo and the peers that are installed and solve such a contact."""
    return [package for package in EVERY if package.present() and package.solves(contact)]


@dataclass(frozen=True)
class Meeting:
    """A package at the loosest tolerance with which it meets a duty, and its answer there."""

    package: Package
    gap: Array
    start: Answer | None
    answer: Answer
    verdict: Verdict

    def again(self) -> Answer:
        """Solve once more."""
        return self.package.solve(self.gap, self.start)


def meet(
    package: type[Package],
    contact: Contact,
    duty: float,
    *,
    before: Array | None = None,
    loosest: float | None = None,
) -> Meeting:
    """Sharpen a package's tolerance by halves until the judge finds its answer good to `duty`.

    Parameters
    ----------
    package : type of Package
        Which.
    contact : Contact
        What to solve.
    duty : float
        Complementarity to meet.
    before : ndarray, optional
        Gap whose answer to start from; a cold start if left out.
    loosest : float, optional
        Tolerance to begin with; 1e-4 if left out.

    Raises
    ------
    RuntimeError
        If no tolerance serves.
    """
    tolerance = loosest or LOOSEST
    while tolerance > 1e-3 * duty:
        made = package(contact, tolerance)
        start = None if before is None else made.solve(before)
        answer = made.solve(contact.gap, start)
        verdict = judge(contact, answer.pressure)
        if verdict.passes(duty):
            return Meeting(made, contact.gap, start, answer, verdict)
        tolerance /= 2
    raise RuntimeError(f"{package.name} does not meet {duty:g}: it reaches {verdict}")
