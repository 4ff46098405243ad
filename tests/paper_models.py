"""Small models of the paper's test, made from objects."""

from tribo.config.stepping import ImplicitConfig
from tribo.contact.dcfft import DcFft, DcFftConfig
from tribo.contact.winkler import Winkler, WinklerConfig
from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.kinematics.reciprocating import Reciprocating, ReciprocatingConfig
from tribo.simulation.assembly import assemble
from tribo.simulation.march import begin, march
from tribo.simulation.model import Body
from tribo.surfaces.flat import Flat, FlatConfig
from tribo.surfaces.paraboloid import Paraboloid, ParaboloidConfig
from tribo.surfaces.sphere import Sphere, SphereConfig
from tribo.wear.archard import Archard, ArchardConfig

K = 3.11e-16
FOUNDATION = 1.2973e15  # Pa/m: matches Hertz's contact radius in the paper's case


def steel(hardness=None):
    return Material(young="207 GPa", poisson=0.3, hardness=hardness)


def archard(k=K):
    return Archard(ArchardConfig(k=k))


def sphere():
    return Sphere(SphereConfig(radius="5 mm"))


def paraboloid():
    return Paraboloid(ParaboloidConfig(radius="5 mm"))


def flat():
    return Flat(FlatConfig())


def half_space(**values):
    return DcFft(DcFftConfig(**values))


def foundation(**values):
    return Winkler(WinklerConfig(**{"modulus": FOUNDATION, **values}))


def motion(**values):
    return Reciprocating(
        ReciprocatingConfig(**{"stroke": "2 mm", "frequency": 25, "duration": 200, **values})
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
