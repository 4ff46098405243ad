"""tribo and its peers, driven alike: set up for a window, then asked for pressures."""

from __future__ import annotations

import warnings
from abc import ABC, abstractmethod
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from typing import Any, ClassVar

import numpy as np

from benchmarks.lib.problems import MODULUS, Contact, Verdict, judge
from tribo import Array, ContactProblem, ContactSolution, ContactSystem, Grid
from tribo.registry.registry import default_registry

MOST_ITERATIONS = 20000


@dataclass(frozen=True)
class Answer:
    """A pressure, the iterations it took where the package tells, and what it starts from."""

    pressure: Array
    iterations: int | None
    raw: Any


class Package(ABC):
    """A package set up for the window of `contact`, to be asked to `tolerance` of its own."""

    name: ClassVar[str]

    def __init__(self, contact: Contact, tolerance: float) -> None:
        self.contact = contact
        self.tolerance = tolerance

    @abstractmethod
    def solve(self, gap: Array, start: Answer | None = None) -> Answer:
        """Return the pressure for `gap`, from an earlier answer of this object or from nothing."""


class Tribo(Package):
    """tribo's `dcfft`, or `periodic`."""

    name = "tribo"

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
        found: ContactSolution = self.solver.solve(problem, start and start.raw)
        return Answer(found.pressure, found.iterations, found)


class Tamaas(Package):
    """tamaas: Polonsky and Keer with Rey's projection; Kato's solver under a cap.

    It gets E* = 1 and a window eight wide: Kato's steps are of one length in the
    caller's units.
    """

    name = "tamaas"
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
        self.solver.solve(self.contact.load / self.contact.width**2 / MODULUS)
        return Answer(np.maximum(traction, 0.0) * MODULUS, None, None)


class ContactMechanics(Package):
    """ContactMechanics: Polonsky and Keer."""

    name = "ContactMechanics"

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


def packages(only: str | None = None) -> list[type[Package]]:
    """Return tribo and the peers that are installed, or those called `only`."""
    every: tuple[type[Package], ...] = (Tribo, Tamaas, ContactMechanics)
    return [p for p in every if find_spec(p.name) and only in (None, p.name)]


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
        Tolerance to begin with; 16 times the duty if left out.

    Raises
    ------
    RuntimeError
        If no tolerance serves.
    """
    tolerance = loosest or 16 * duty
    while tolerance > 1e-3 * duty:
        made = package(contact, tolerance)
        start = None if before is None else made.solve(before)
        answer = made.solve(contact.gap, start)
        verdict = judge(contact, answer.pressure)
        if verdict.passes(duty):
            return Meeting(made, contact.gap, start, answer, verdict)
        tolerance /= 2
    raise RuntimeError(f"{package.name} does not meet {duty:g}: it reaches {verdict}")
