"""Small models of the paper's test, made from objects."""

from tribo.config.stepping import ImplicitConfig
from tribo.contact.dcfft import DcFft
from tribo.contact.winkler import Winkler
from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.kinematics.reciprocating import Reciprocating
from tribo.simulation.assembly import assemble
from tribo.simulation.march import begin, march
from tribo.simulation.model import Body
from tribo.surfaces.flat import Flat
from tribo.surfaces.paraboloid import Paraboloid
from tribo.surfaces.sphere import Sphere
from tribo.wear.archard import Archard

K = 3.11e-16
FOUNDATION = 1.2973e15  # Pa/m: matches Hertz's contact radius in the paper's case


def steel(hardness=None):
    return Material(young="207 GPa", poisson=0.3, hardness=hardness)


def archard(k=K):
    return Archard(k=k)


def sphere():
    return Sphere(radius="5 mm")


def paraboloid():
    return Paraboloid(radius="5 mm")


def flat():
    return Flat()


def half_space(**values):
    return DcFft(**values)


def foundation(**values):
    return Winkler(**{"modulus": FOUNDATION, **values})


def motion(**values):
    return Reciprocating(
        Reciprocating(**{"stroke": "2 mm", "frequency": 25, "duration": 200, **values})
    )


def small(**changes):
    """The paper's test for 200 s on 48² cells, with changes."""
    parts = {
        "grid": Grid((0.7e-3, 0.7e-3), (48, 48)),
        "load": 100.0,
        "bodies": [
            Body("ball", sphere(), steel(), archard()),
            Body("disk", flat(), steel(), archard()),
        ],
        "contact": half_space(),
        "kinematics": motion(),
        "stepping": ImplicitConfig(),
    }
    return assemble(**{**parts, **changes})


def states(model):
    """Every accepted state, the first contact included."""
    first = begin(model)
    return [first] + [accepted.state for accepted in march(model, first)]


def last(model):
    return states(model)[-1]
