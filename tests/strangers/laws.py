"""The hooks of the strangers' laws and effect: what a scaffold writes."""

from strangers.oxidation import OxideFilm
from strangers.protected import Protected
from strangers.running_in import RunningIn

from tribo import hookimpl

__version__ = "1.0"


@hookimpl
def tribo_components() -> tuple[type, ...]:
    return Protected, RunningIn, OxideFilm
