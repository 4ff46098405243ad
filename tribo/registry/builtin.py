"""The components that come with tribo, offered through the same hook as any other."""

from __future__ import annotations

from tribo.component import Component
from tribo.contact.dcfft import DcFft
from tribo.contact.periodic import Periodic
from tribo.contact.winkler import Winkler
from tribo.motion.closed_track import Rotating, Unidirectional
from tribo.motion.measured import Measured
from tribo.motion.planar import Planar
from tribo.motion.reciprocating import Reciprocating
from tribo.observers.progress import Progress
from tribo.registry.hookspecs import hookimpl
from tribo.surfaces.forms import Cylinder, Flat, Paraboloid, Sphere
from tribo.surfaces.height_map import HeightMap
from tribo.surfaces.pin import Pin
from tribo.surfaces.relief import Texture, Waves
from tribo.surfaces.rough import Rough
from tribo.wear.archard import Archard, Power
from tribo.wear.modified import Scaled
from tribo.wear.running_in import RunningIn, Smoothing


@hookimpl
def tribo_components() -> tuple[type[Component], ...]:
    """Offer contact solvers, wear laws, motions, surfaces and observers."""
    return (
        *(DcFft, Periodic, Winkler),
        *(Archard, Power, RunningIn, Scaled, Smoothing),
        *(Measured, Planar, Reciprocating, Rotating, Unidirectional),
        *(Sphere, Paraboloid, Cylinder, Flat, Pin, HeightMap, Rough, Texture, Waves),
        Progress,
    )
