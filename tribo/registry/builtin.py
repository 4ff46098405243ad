"""The components that come with tribo, offered through the same hooks as any other."""

from __future__ import annotations

from collections.abc import Iterable

from tribo.interfaces.contact import ContactSolver
from tribo.interfaces.kinematics import Kinematics
from tribo.interfaces.observer import Observer
from tribo.interfaces.surface import Surface
from tribo.interfaces.wear import WearLaw
from tribo.registry.hookspecs import hookimpl


@hookimpl
def tribo_contact_solvers() -> Iterable[type[ContactSolver]]:
    """Offer the elastic half-space, in free space and periodic, and the elastic foundation."""
    from tribo.contact.dcfft import DcFft
    from tribo.contact.periodic import Periodic
    from tribo.contact.winkler import Winkler

    return DcFft, Periodic, Winkler


@hookimpl
def tribo_wear_laws() -> Iterable[type[WearLaw]]:
    """Offer Archard's law and a power law."""
    from tribo.wear.archard import Archard
    from tribo.wear.power import Power

    return Archard, Power


@hookimpl
def tribo_kinematics() -> Iterable[type[Kinematics]]:
    """Offer reciprocating and unidirectional sliding."""
    from tribo.kinematics.reciprocating import Reciprocating
    from tribo.kinematics.unidirectional import Unidirectional

    return Reciprocating, Unidirectional


@hookimpl
def tribo_surfaces() -> Iterable[type[Surface]]:
    """Offer smooth surfaces of simple shape."""
    from tribo.surfaces.cylinder import Cylinder
    from tribo.surfaces.flat import Flat
    from tribo.surfaces.paraboloid import Paraboloid
    from tribo.surfaces.sphere import Sphere

    return Sphere, Paraboloid, Cylinder, Flat


@hookimpl
def tribo_observers() -> Iterable[type[Observer]]:
    """Offer the recorder and the progress display."""
    from tribo.observers.progress import Progress
    from tribo.observers.recorder import Recorder

    return Recorder, Progress
