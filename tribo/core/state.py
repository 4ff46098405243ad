"""Everything that evolves in a run, as frozen values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from tribo.core.arrays import Array
from tribo.core.column import Column
from tribo.core.contact import ContactSolution, ContactSystem
from tribo.core.fields import Field, WearRate
from tribo.core.findings import Finding
from tribo.core.measures import Invariants, Measures


@dataclass(frozen=True)
class BodyState:
    """The wear, plastic depth and states of one body's surface.

    Parameters
    ----------
    wear : ndarray
        Depth worn away, in m; on the body's own surface: shape (nx, ny),
        (1, ny) on a moving body under an average along its track, and (rows, ny)
        on a moving body of a resolved cycle.
    plastic : ndarray
        Permanent displacement by plastic flow, in m, positive into the body; shape (nx, ny), or
        (rows, ny) on a moving body of a resolved cycle.
    law : Mapping[str, ndarray]
        State fields of the body's wear law, shaped as `wear`.

    Examples
    --------
    >>> disk = tribo.BodyState(wear=np.full((1, 4), 2e-6), plastic=np.zeros((4, 4)), law={})
    >>> disk.wear.shape  # averaged along its track
    (1, 4)
    """

    wear: Array
    plastic: Array
    law: Mapping[str, Array]


@dataclass(frozen=True)
class State:
    """The whole memory of a run: a step is a pure function of case and state.

    Parameters
    ----------
    time, distance : float
        Time in s and sliding distance in m.
    bodies : Mapping[str, BodyState]
        Their wear and states, by name.
    between : Mapping[str, ndarray]
        State fields of the effects, by name, as ``"film of disk"`` on a body: shape (nx, ny) in the
        contact frame, where one state serves all positions of a cycle, as `BodyState.wear` on a
        body, (1, 1) if uniform.
    contacts : tuple of ContactSolution
        The solved contact at each position of a cycle; they belong to the geometry
        of `bodies` and are the start of the next solves.
    increment : float
        Sliding increment the step control would take next, in m.
    reference_depth : float
        Approach of the first contact, in m: the depth against which the
        first increments are judged.
    load_distance : float
        Load times sliding distance, summed over the steps, in N m.
    friction_energy : float
        Work of friction, summed over the steps, in J; 0 without a coefficient of friction.
    steps, rejected_steps, contact_solves, solver_iterations, saves : int
        Counted from the beginning of the run.
    rates : sequence of Mapping[str, WearRate]
        Rates of the laws at the end of the last implicit step, by position and body, in the
        contact frame: where the next one begins. Empty where there are none.
    findings : tuple of Finding
        The findings of the run so far, each once.
    invariants : Invariants
        Their errors in the step that led here.
    previous : tuple of ndarray, shape (nx, ny)
        Pressure at each position a step ago, in Pa, to start the next
        solve; empty before the first.
    speed : float
        Mean sliding speed of the last step, in m/s, 0 at rest; at first the speed of the motion
        soon after.
    load_factor : float
        Factor of effects on the normal load, in the contacts and in the next step.

    Examples
    --------
    >>> from tribo.kernel_api import begin
    >>> springs = "contact.type=winkler"
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=springs)
    >>> state = begin(tribo.Simulation(case).model)
    >>> round(1e6 * state.contact.approach, 1)  # of the first contact, in µm
    2.2
    """

    time: float
    distance: float
    bodies: Mapping[str, BodyState]
    contacts: tuple[ContactSolution, ...]
    increment: float
    reference_depth: float
    load_distance: float
    steps: int = 0
    rejected_steps: int = 0
    contact_solves: int = 1
    solver_iterations: int = 0
    saves: int = 0
    rates: Sequence[Mapping[str, WearRate]] = ()
    between: Mapping[str, Array] = field(default_factory=dict)
    friction_energy: float = 0.0
    findings: tuple[Finding, ...] = ()
    invariants: Invariants = field(default_factory=Invariants)
    previous: tuple[Array, ...] = ()
    speed: float = 0.0
    load_factor: float = 1.0

    @property
    def contact(self) -> ContactSolution:
        """The contact in the middle of the cycle, which a result shows."""
        return self.contacts[len(self.contacts) // 2]

    def without_findings(self, kind: str) -> State:
        """Return the state without findings of this kind."""
        return replace(self, findings=tuple(each for each in self.findings if each.kind != kind))

    def with_findings(self, *more: Finding) -> State:
        """Return the state with more findings."""
        return replace(self, findings=(*self.findings, *more))

    def from_here(self, finding: Finding) -> State:
        """Return the state with a finding from its time and distance on, once for its place."""
        if (finding.kind, finding.place) in {(each.kind, each.place) for each in self.findings}:
            return self
        return self.with_findings(finding.at(self.time, self.distance))

    def remembered(self, body: str, field: str) -> Array:
        """Return a state field on a body's surface, of its law or of an effect on it."""
        law = self.bodies[body].law
        return law[field] if field in law else self.between[key_of(field, body)]


def key_of(field: str, body: str | None) -> str:
    """Return the key in `State.between` of an effect's state; no body for the contact."""
    return field if body is None else f"{field} of {body}"


@dataclass(frozen=True)
class BodyInfo:
    """The constant facts of a body.

    Parameters
    ----------
    name : str
        Its name in the case.
    swept : bool
        Whether its points pass through the contact.
    density : float or None
        In kg/m³.
    height : ndarray, shape (nx, ny)
        Its initial height outward, in m.
    rows : int
        Cells along x on its own surface.
    state_fields : tuple of Field, optional
        States of its wear law per material point, and states of effects on it.
    straight : bool, optional
        Whether its points pass along x alone, if they do.

    Examples
    --------
    >>> disk = tribo.BodyInfo("disk", swept=True, density=7850.0, height=np.zeros((4, 4)), rows=1)
    >>> volume = 2e-12
    >>> round(1e6 * disk.density * volume, 4)  # mass of 0.002 mm³, in mg
    0.0157
    """

    name: str
    swept: bool
    density: float | None
    height: Array
    rows: int
    state_fields: tuple[Field, ...] = ()
    straight: bool = True


@dataclass(frozen=True)
class RunInfo:
    """The input of an observer before a run begins.

    Parameters
    ----------
    system : ContactSystem
        The constants of the contact: window, load, modulus.
    bodies : tuple of BodyInfo
        In the order of the case.
    end_time, end_distance : float
        End of the run if nothing stops it, in s, and the sliding distance by then, in m.
    case : Mapping[str, object]
        The full configuration, as plain data.
    provenance : Mapping[str, object]
        Versions and the classes that take part, as plain data.
    effect_fields : tuple of Field, optional
        The fields of the effects.
    between_fields : tuple of Field, optional
        States of the effects in the contact frame, or as one number.
    columns : tuple of Column, optional
        Numbers that models and observers add to each step.
    resumed_from : Snapshot or None
        The state a resumed run starts from.
    wall_time : float
        Time spent before the run was resumed, in s.

    Examples
    --------
    >>> class Plan(tribo.Observer):
    ...     type = "my.plan"
    ...     def on_start(self, run):
    ...         print(f"{run.end_distance:g} m under {run.system.load:g} N")
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> result = case.run(observers=[Plan()])
    360 m under 100 N
    """

    system: ContactSystem
    bodies: tuple[BodyInfo, ...]
    end_time: float
    end_distance: float
    case: Mapping[str, object]
    provenance: Mapping[str, object]
    effect_fields: tuple[Field, ...] = ()
    between_fields: tuple[Field, ...] = ()
    columns: tuple[Column, ...] = ()
    resumed_from: Snapshot | None = None
    wall_time: float = 0.0


@dataclass(frozen=True)
class Snapshot:
    """A moment of a run: its state, its scalars and the fields of effects.

    Parameters
    ----------
    state : State
        The state.
    measures : Measures
        Its scalars.
    effects : Mapping[str, Mapping[str, ndarray]], optional
        Fields of the effects for the pressure and speed of `state`, by field
        and body, shape (nx, ny). Empty except at saves, unless a model or observer has columns.
    columns : Mapping, optional
        Values of the columns of models and observers, by name: a number, or numbers by body.

    Examples
    --------
    >>> class Deepest(tribo.Observer):
    ...     type = "my.deepest"
    ...     def on_save(self, snapshot):
    ...         depth = snapshot.measures.bodies["ball"].max_wear_depth
    ...         print(f"{1e6 * depth:.2f} µm at {snapshot.state.time:.1f} s")
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> result = case.run(observers=[Deepest()])
    0.00 µm at 0.0 s
    1.00 µm at 13.2 s
    """

    state: State
    measures: Measures
    effects: Mapping[str, Mapping[str, Array]] = field(default_factory=dict)
    columns: Mapping[str, float | Mapping[str, float]] = field(default_factory=dict)
