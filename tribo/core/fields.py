"""The local fields that models declare, require and provide."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

from tribo.core.arrays import Array
from tribo.core.contact import ContactSystem
from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.core.units import scale


@dataclass(frozen=True)
class Field:
    """The declaration of a local field: what it means and in which unit.

    Parameters
    ----------
    name : str
        The name by which models refer to it.
    unit : str
        Its SI unit; ``"1"`` for none.
    description : str
        What it means, in one sentence.
    at_least, at_most : float, optional
        Limits that its values keep.
    typical : float, optional
        A usual value, at which models that require it are tested.
    uniform : bool, optional
        Whether the state of an effect is one number, such as the temperature of a bath, and not one
        at each point.
    fills : bool, optional
        Whether a state is a height, in m, that fills the gap: the bodies meet on it, as on debris
        or on a film that has grown.
    breaks : tuple of float, optional
        Values of a state at which a rate jumps, rising. A step ends at a point where its state
        reaches a break, and a new one starts there; at the break itself the rates above it hold.

    Examples
    --------
    >>> print(tribo.Field("film_thickness", "m", "Thickness of the oil film.", at_least=0.0))
    film_thickness [m] Thickness of the oil film.
    """

    name: str
    unit: str
    description: str
    at_least: float | None = None
    at_most: float | None = None
    typical: float | None = None
    uniform: bool = False
    fills: bool = False
    breaks: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        """Refuse a unit that is not SI, in which values would be wrong without a word."""
        if scale(self.unit)[0] != 1:
            raise ValueError(f"the unit {self.unit!r} of the field {self.name!r} is not SI")

    def __str__(self) -> str:
        return f"{self.name} [{self.unit}] {self.description}"


def check_declared(owner: object, who: str) -> None:
    """Check the fields that a class provides or keeps, and the names of fields that it requires.

    `TypeError`, in which the class is called `who`, if they are not tuples of `Field`, each with a
    name of its own, and of names. Of properties only objects have the answer.
    """
    for attribute in ("provides", "state_fields", "material_properties"):
        fields, where = getattr(owner, attribute, ()), f"{who}.{attribute}"
        if isinstance(fields, property):
            continue
        if not (isinstance(fields, tuple | list) and all(isinstance(f, Field) for f in fields)):
            raise TypeError(
                f"{where} is {fields!r}; it must be a tuple of Field, as in "
                '(Field("name", "m", "What it means."),)'
            )
        names = [field.name for field in fields]
        for name in names:
            if not (isinstance(name, str) and name.isidentifier()):
                raise TypeError(
                    f"{where}: {name!r} cannot name a field; letters, digits and underscores are "
                    "allowed, no digit first"
                )
            if names.count(name) > 1:
                raise TypeError(f"{where}: the field {name!r} is declared twice")
        for each in fields:
            if list(each.breaks) != sorted(set(each.breaks)):
                raise TypeError(f"{where}: the breaks of {each.name!r} must rise: {each.breaks}")
            if each.fills and (each.unit != "m" or attribute != "state_fields"):
                raise TypeError(
                    f"{where}: {each.name!r} cannot fill the gap: only a height that is kept as "
                    "state (state_fields) can, in m"
                )
    required = getattr(owner, "requires", ())
    named = isinstance(required, tuple | list) and all(isinstance(n, str | Field) for n in required)
    if not (named or isinstance(required, property)):
        raise TypeError(
            f"{who}.requires is {required!r}; it must be a tuple of names or of Field, as in "
            '("temperature",)'
        )


def names_of(required: Iterable[str | Field]) -> tuple[str, ...]:
    """Return the names of fields that are required, by name or with their declaration."""
    return tuple(each.name if isinstance(each, Field) else each for each in required)


FRICTION_COEFFICIENT = Field(
    "friction_coefficient",
    "1",
    "Coefficient of friction, of the case or of an effect.",
    at_least=0.0,
    typical=0.3,
)
LOAD_SHARE = Field(
    "load_share",
    "1",
    "Part of the pressure that what lies between the bodies carries; the rest wears them.",
    at_least=0.0,
    at_most=1.0,
    typical=0.3,
)
LOCAL_SLIP = Field(
    "local_slip",
    "1",
    "Path that a point slips for each metre of the motion, as in partial slip.",
    at_least=0.0,
    at_most=1.0,
    typical=0.5,
)
WORN_DEPTH = Field("worn_depth", "m", "Depth that a point of the body has lost.")
"""A law that lists it in its `state_fields` gets it as an input; its rate is the depth rate.

The run already has it: it is not saved twice, and does not restart at 0. ``replace(WORN_DEPTH,
breaks=…)`` declares the depths at which the rate jumps.
"""
PLACE_X = Field(
    "place_x", "m", "Place along x on the body's own surface, 0 in its middle.", typical=1e-4
)
PLACE_Y = Field(
    "place_y", "m", "Place along y on the body's own surface, 0 in its middle.", typical=1e-4
)
HEADING_X = Field(
    "heading_x",
    "1",
    "Direction in which the other body slides over the body: x of a vector of length 1.",
    at_least=-1.0,
    at_most=1.0,
    typical=0.6,
)
HEADING_Y = replace(
    HEADING_X,
    name="heading_y",
    description="Which way the other body slides over the body, along y.",
    typical=0.8,
)
OF_MOTION = {field.name: field for field in (PLACE_X, PLACE_Y, HEADING_X, HEADING_Y)}
"""Fields that the motion of a case provides to any law or effect that requires them."""


@dataclass(frozen=True)
class LocalConditions:
    """The input of a wear law: conditions at each point of the contact, for one body.

    Arrays have shape (positions, nx, ny), one position of an average, are in the contact
    frame and must not be written to.

    Parameters
    ----------
    pressure : ndarray
        Contact pressure, in Pa.
    speed : ndarray, shape (positions, 1, 1)
        Sliding speed, in m/s: one of those that the motion has in a cycle, or
        its mean over the step.
    material : Material
        The body's material.
    fields : Mapping[str, ndarray]
        The fields the law requires, as its effects and the case provide them.
    state : Mapping[str, ndarray]
        The law's own state fields, at the points now in contact.

    Examples
    --------
    >>> pressure = np.array([[[0.0, 1e9]]])
    >>> local = tribo.LocalConditions(pressure, speed=0.1, material=tribo.materials["100Cr6"])
    >>> rate = tribo.Archard(k="1e-6 mm^3/(N m)").rate(local)
    >>> (1e6 * rate.depth_rate).round(3).tolist()  # µm per metre of sliding
    [[[0.0, 1.0]]]
    """

    pressure: Array
    speed: Array | float
    material: Material
    fields: Mapping[str, Array] = field(default_factory=dict)
    state: Mapping[str, Array] = field(default_factory=dict)


@dataclass(frozen=True)
class WearRate:
    """The answer of a wear law: arrays of the pressure's shape, or that broadcast to it.

    Parameters
    ----------
    depth_rate : ndarray
        Depth worn away per metre of sliding, in m/m; not negative.
    depth_slope : ndarray, optional
        Derivative of `depth_rate` in pressure, in 1/Pa, with the fields as they
        are; through a field only if the law requires the slope of that field
        too. Implicit steps converge by it. Where it is left out, the law is asked
        once more at slightly higher pressures. How long an explicit step may be
        is found by difference, through all fields.
    state_rates : Mapping[str, ndarray]
        Change of each state field per metre of sliding; 0 where the pressure is 0.

    Examples
    --------
    >>> pressure, k = np.array([[[0.0, 1e9]]]), 1e-15
    >>> rate = tribo.WearRate(k * pressure, depth_slope=np.full_like(pressure, k))
    >>> float(1e6 * rate.at(0).depth_rate.max().round(9))  # µm per metre of sliding
    1.0
    """

    depth_rate: Array
    # None only in the answer of a law; a run has found it by then.
    depth_slope: Array = None  # type: ignore[assignment]
    state_rates: Mapping[str, Array] = field(default_factory=dict)

    def at(self, position: int) -> WearRate:
        """Return the rate at one of several positions."""
        states = {name: rate[position] for name, rate in self.state_rates.items()}
        return WearRate(self.depth_rate[position], self.depth_slope[position], states)


@dataclass(frozen=True)
class ContactConditions:
    """The input of an effect: the whole contact at one moment.

    Parameters
    ----------
    system : ContactSystem
        The contact, as in `Effect.check`.
    pressure : ndarray, shape (nx, ny)
        Contact pressure, in Pa.
    speed : float
        Sliding speed, in m/s: one of those that the motion has in a cycle, or
        its mean over the step.
    time : float
        Time at the end of the step, in s; or within it, where laws or effects keep a state.
    distance : float
        Sliding distance then, in m.
    swept : frozenset of str
        Names of the bodies whose points pass through the contact.
    track : float
        Length of their track, in m: the stroke, or once round; infinite where they do not come
        back.
    turns_back : bool
        Whether the motion goes to and fro along it, rather than round it.
    fields : Mapping[str, Mapping[str, ndarray]]
        Fields of the effects that ran before, and required states of effects and wear laws, by
        field and body; a state of laws, for the bodies whose law has it.
    state : Mapping[str, ndarray]
        The effect's own state fields in the window, shape (nx, ny), or (1, 1) if uniform.
    wear_rates : Mapping[str, ndarray]
        Depth that each body loses per metre of sliding, in m/m, by name; empty for `Effect.fields`,
        on which these depend.

    Examples
    --------
    >>> system = tribo.ContactSystem(tribo.Grid("1 mm", 4), modulus=115e9, load=10.0)
    >>> pressure = np.full((4, 4), 10e6)
    >>> contact = tribo.ContactConditions(system, pressure, 0.1, 0.0, 0.0, swept=frozenset())
    >>> heat = 0.3 * contact.pressure * contact.speed * contact.grid.cell_area
    >>> round(float(heat.sum()), 3)  # power of friction in W, at a coefficient of 0.3
    0.3
    """

    system: ContactSystem
    pressure: Array
    speed: float
    time: float
    distance: float
    swept: frozenset[str]
    track: float = math.inf
    turns_back: bool = False
    fields: Mapping[str, Mapping[str, Array]] = field(default_factory=dict)
    state: Mapping[str, Array] = field(default_factory=dict)
    wear_rates: Mapping[str, Array] = field(default_factory=dict)

    @property
    def grid(self) -> Grid:
        """The window."""
        return self.system.grid

    @property
    def materials(self) -> Mapping[str, Material]:
        """The bodies' materials, by name."""
        return self.system.materials
