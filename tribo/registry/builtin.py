"""The components that come with tribo, offered through the same hook as any other."""

from __future__ import annotations

from typing import Any

from tribo.contact.dcfft import DcFft
from tribo.contact.periodic import Periodic
from tribo.contact.winkler import Winkler
from tribo.interfaces.component import Component
from tribo.kinematics.reciprocating import Reciprocating
from tribo.kinematics.unidirectional import Unidirectional
from tribo.observers.progress import Progress
from tribo.observers.recorder import Recorder
from tribo.registry.hookspecs import hookimpl
from tribo.surfaces.cylinder import Cylinder
from tribo.surfaces.flat import Flat
from tribo.surfaces.paraboloid import Paraboloid
from tribo.surfaces.sphere import Sphere
from tribo.wear.archard import Archard
from tribo.wear.power import Power


@hookimpl
def tribo_components() -> tuple[type[Component[Any]], ...]:
    """Offer contact solvers, wear laws, motions, surfaces and observers."""
    return (
        *(DcFft, Periodic, Winkler),
        *(Archard, Power),
        *(Reciprocating, Unidirectional),
        *(Sphere, Paraboloid, Cylinder, Flat),
        *(Recorder, Progress),
    )
