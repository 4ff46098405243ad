"""The whole input of a simulation."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Self

from pydantic import BaseModel, Field, ValidationInfo, field_validator, model_validator

from tribo.component import components
from tribo.contact.dcfft import DcFft
from tribo.contact.solver import ContactSolver
from tribo.core.errors import CaseError
from tribo.core.explain import refused
from tribo.core.grid import Grid
from tribo.core.loads import Load
from tribo.core.material import Material, Poisson
from tribo.core.shorthand import call
from tribo.core.table import Table, tree
from tribo.core.units import Quantity
from tribo.core.words import checked_name, did_you_mean, suggestion
from tribo.effects.effect import Effect
from tribo.motion.kinematics import Kinematics
from tribo.observers.observer import Observer
from tribo.stepping.explicit import Explicit
from tribo.stepping.implicit import Implicit
from tribo.surfaces.surface import Surface
from tribo.wear.law import WearLaw

if TYPE_CHECKING:
    from tribo.result.read import Result
    from tribo.study.check import Check


SHORT = {"load": "normal", "friction": "coefficient"}
"""Tables of a case for which the value of one key is short."""


class Layer(Table):
    """A layer of a body, with what differs from the body below it.

    Examples
    --------
    >>> coating = tribo.Layer(thickness="2 um", young="300 GPa")
    >>> known = coating.material(below=tribo.materials["100Cr6"])
    >>> known.young, known.poisson  # its own; of the body below
    (300000000000.0, 0.3)
    """

    thickness: Annotated[float, Quantity("m", above=0, usual=(1e-9, 1e-2))]
    """Thickness of the layer."""
    wear: WearLaw | None = None
    """Wear law of the layer; the body's if left out."""
    young: Annotated[float, Quantity("Pa", above=0, usual=(1e4, 2e12))] | None = None
    """Young's modulus; the body's if left out."""
    poisson: Poisson | None = None
    """Poisson's ratio; the body's if left out."""
    hardness: Annotated[float, Quantity("Pa", above=0, usual=(1e4, 2e11))] | None = None
    """Hardness, for laws that use it; the body's if left out."""

    def material(self, below: Material) -> Material:
        """Return its material on a body of `below`."""
        named = {name: getattr(self, name) for name in ("young", "poisson", "hardness")}
        return below.model_copy(update={k: v for k, v in named.items() if v is not None})


class Body(Table):
    """One of the two bodies.

    Examples
    --------
    >>> soft, hard = tribo.Archard(k="3e-7 mm^3/(N m)"), tribo.Archard(k="1e-8 mm^3/(N m)")
    >>> coating = tribo.Layer(thickness="2 um", wear=hard)
    >>> disk = tribo.Body(surface=tribo.Flat(), material="100Cr6", wear=soft, layers=[coating])
    >>> disk.laws() == (hard, soft)  # from the top
    True
    """

    surface: Surface
    """Shape before wear."""
    material: Material
    """Material of the body."""
    wear: WearLaw | None = None
    """Wear law; the body does not wear if left out."""
    layers: tuple[Layer, ...] = ()
    """Layers on it, from the top; `material` and `wear` belong to the body below them."""

    @classmethod
    def hint(cls, info: object) -> str:
        """Return how many a case needs, as the end of a message."""
        return "a contact needs two bodies, as [bodies.ball] and [bodies.disk]"

    @model_validator(mode="after")
    def _wears_in_layers(self) -> Self:
        if self.layers and self.wear is None:
            raise ValueError(
                "layers wear through to the body: give its wear, as { type = 'archard', k = 0 } if "
                "it does not wear"
            )
        return self

    def laws(self) -> tuple[WearLaw, ...]:
        """Return its wear laws, the layers' first; none if it does not wear."""
        if self.wear is None:
            return ()
        return (*(layer.wear or self.wear for layer in self.layers), self.wear)

    def materials(self) -> tuple[Material, ...]:
        """Return its materials, the layers' first."""
        return (*(layer.material(self.material) for layer in self.layers), self.material)


def _of_own_material(body: Any, own: Mapping[str, Material]) -> Any:
    """Return the table of a body whose material is named with the numbers of that name."""
    given = body.get("material") if isinstance(body, Mapping) else None
    table = {"name": given} if isinstance(given, str) else given
    if not isinstance(table, Mapping) or not isinstance(name := table.get("name"), str):
        return body
    if name not in own:
        return body
    return {**body, "material": {**own[name].model_dump(exclude_none=True), **table}}


class Friction(Table):
    """Friction, for the laws and effects that ask for it; it does not act on the contact.

    Examples
    --------
    >>> tribo.Friction(coefficient=0.6).coefficient
    0.6
    """

    coefficient: Annotated[float, Quantity("1", at_least=0, usual=(1e-4, 2.0))]
    """Coefficient of friction, uniform and constant."""


SaveTime = Annotated[float | str, Quantity("s", at_least=0, also=("m", "lap"))]
"""A time, or the path slid by then."""


class Output(Table):
    """The output times.

    Examples
    --------
    >>> tribo.Output(save_times=["10 min", "100 m"]).save_times
    (600.0, '100 m')
    """

    save_times: tuple[SaveTime, ...] = ()
    """When all fields are saved, by time or by the path slid until then, as ``"100 m"`` or
    ``"500 laps"``; t = 0 and the end always are."""


class Stop(Table):
    """Ends the run at the first condition that is met.

    Examples
    --------
    >>> tribo.Stop(depth="5 um", body="ball").whose(["ball", "disk"])
    ['ball']
    """

    distance: Annotated[float | str, Quantity("m", above=0, also=("lap",))] | None = None
    """Sliding distance, in m or in laps."""
    depth: Annotated[float, Quantity("m", above=0)] | None = None
    """Largest wear depth."""
    body: str | None = None
    """Name of the body whose depth counts; either, if left out."""

    @model_validator(mode="after")
    def _body_needs_depth(self) -> Self:
        if self.body is not None and self.depth is None:
            raise ValueError("body says whose depth counts: give depth too")
        return self

    def whose(self, bodies: Iterable[str]) -> list[str]:
        """Return the names of the bodies whose depth counts, of all."""
        return [self.body] if self.body else list(bodies)


class Case(Table):
    """A case: two bodies, a load, a motion, and how to compute.

    Examples
    --------
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml")
    >>> case.kinematics.end_time, case.bodies["ball"].material.hardness  # in s and Pa
    (3600.0, 4000000000.0)
    """

    grid: Grid
    load: Load
    materials: dict[str, Material] = Field({})
    """Materials of one's own, by the names that bodies may give."""
    bodies: dict[str, Body]
    """The two bodies, by name."""
    begin: str | None = None
    """The result with whose worn bodies the run begins, a relative name from the current directory;
    unworn if left out."""
    contact: ContactSolver = DcFft()
    """How the normal contact is solved."""
    kinematics: Kinematics
    """How the bodies move."""
    stepping: Annotated[Implicit | Explicit, Field(discriminator="type")] = Implicit()
    """How the run moves on in time."""
    friction: Friction | None = None
    effects: tuple[Effect, ...] = ()
    """Effects, such as a temperature of the contact."""
    observers: tuple[Observer, ...] = ()
    """Observers, which watch the run."""
    output: Output = Output()
    stop: Stop = Stop()

    @field_validator(*SHORT, mode="before")
    @classmethod
    def _short(cls, value: Any, info: ValidationInfo) -> Any:
        if value is None or isinstance(value, Mapping | BaseModel):
            return value
        return {SHORT[str(info.field_name)]: value}

    @field_validator("begin", mode="before")
    @classmethod
    def _path(cls, value: Any) -> Any:
        return str(value) if isinstance(value, Path) else value

    @field_validator("contact", "stepping", mode="before")
    @classmethod
    def _default_type(cls, table: Any, info: ValidationInfo) -> Any:
        if isinstance(table, Mapping) and "type" not in table:
            default = cls.model_fields[str(info.field_name)].default
            return {"type": default.type, **table}
        return table

    @field_validator("bodies", mode="before")
    @classmethod
    def _two_bodies(cls, bodies: Any, info: ValidationInfo) -> Any:
        if not isinstance(bodies, Mapping):
            return bodies
        if len(bodies) != 2:
            given = ", ".join(map(str, bodies)) or "none"
            raise ValueError(f"{Body.hint(info)}; given: {given}")
        for name in bodies:
            checked_name(str(name))
        own = info.data.get("materials", {})
        return {name: _of_own_material(body, own) for name, body in bodies.items()}

    @model_validator(mode="after")
    def _read_properties(self) -> Self:
        """Read what models need of the materials, each property in its unit."""
        needs = [(at, part, f) for at, part in components(self) for f in part.material_properties]
        known = dict.fromkeys(field.name for _, _, field in needs)
        wrong: list[tuple[tuple[str, ...], str, object]] = []
        for name, body in self.bodies.items():
            place = ("bodies", name, "material")
            keys, given = dict(body.material), body.material.properties or {}
            read = dict(given)
            for key in [key for key in given if key not in known]:
                like = suggestion(did_you_mean(key, known))
                text = f"no model of this case needs it{like} Needed: {', '.join(known) or 'none'}"
                wrong.append(((*place, "properties", key), text, given[key]))
            for at, part, field in needs:
                key, value = field.name, given.get(field.name, keys.get(field.name))
                mark = Quantity(field.unit, at_least=field.at_least, at_most=field.at_most)
                try:
                    if value is not None:
                        number = mark.read(value)
                        read |= {key: number} if key in given else {}
                    elif at.startswith(f"bodies.{name}.") or not at.startswith("bodies."):
                        raise CaseError(f"{part.type!r} needs it of {name!r}: {mark.hint()}")
                except CaseError as error:
                    where = place if key in keys else (*place, "properties")
                    wrong.append(((*where, key), str(error), value))
            own = self.materials.get(body.material.name or "")
            material = body.material.model_copy(update={"properties": read or None})
            if own and own.properties == body.material.properties:
                update = {"properties": material.properties}
                self.materials[str(material.name)] = own.model_copy(update=update)
            self.bodies[name] = body.model_copy(update={"material": material})
        if wrong:
            raise refused(*wrong)
        return self

    def __str__(self) -> str:
        """Return a short tree of what is not at its default."""
        return tree(self)

    def _repr_pretty_(self, printer: Any, cycle: bool) -> None:
        """Show the tree in a notebook."""
        printer.text(tree(self))

    def with_values(self, settings: Mapping[str, Any]) -> Case:
        """Return this case with other values.

        Parameters
        ----------
        settings : Mapping
            Values by path, as in a case file; another ``type`` drops the other keys of its table.

        Raises
        ------
        CaseError
            If a path leads nowhere, or the new case is wrong.

        Examples
        --------
        >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml")
        >>> case.with_values({"load.normal": "50 N", "contact.type": "winkler"}).load.normal
        50.0
        """
        case: Case = call("changed", self, settings)
        return case

    def check(self) -> Check:
        """Predict the first contact and the end of a run, and what would go wrong on its way."""
        found: Check = call("check", self)
        return found

    def run(
        self, output: str | Path | None = None, *, progress: bool = False, **options: Any
    ) -> Result:
        """Run from the beginning, as ``Simulation(case).run(output, …)``, with a bar if wanted.

        `options` go to `Simulation.run`: ``observers=[…]``, ``overwrite=True``.
        """
        if progress:
            from tribo.observers.progress import Progress

            options["observers"] = [*options.get("observers", ()), Progress()]
        result: Result = call("simulation", self).run(output, **options)
        return result


def keys() -> Iterable[str]:
    """Return the keys of a case that stand above the first table of its file."""
    return Case.model_fields
