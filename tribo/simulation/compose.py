"""Turn a validated case into a model of objects."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from tribo.config.case import Case
from tribo.config.usual import unusual
from tribo.core.errors import CaseError
from tribo.interfaces.component import ComponentConfig
from tribo.registry.registry import Registry, default_registry
from tribo.simulation.assembly import assemble
from tribo.simulation.calling import calling
from tribo.simulation.doubt import doubting
from tribo.simulation.effects import MissingFieldError
from tribo.simulation.model import Body, Model


def compose(case: Case, registry: Registry | None = None) -> Model:
    """Make the objects that a case names, and join them.

    Parameters
    ----------
    case : Case
        A validated case.
    registry : Registry, optional
        Where to look classes up; the installed plugins if left out.

    Raises
    ------
    CaseError
        If the parts do not fit together.
    """
    known = registry or default_registry()

    def make(kind: str, config: ComponentConfig) -> Any:
        cls = known.lookup(kind, config.type)
        with calling(cls):
            return cls(config)

    try:
        with doubting(lambda: unusual(case)):
            return _assembled(case, make)
    except MissingFieldError as error:
        providers = known.providers(error.missing)
        if not providers:
            raise
        raise CaseError(f"{error}; these do: {', '.join(providers)}") from error


def _assembled(case: Case, make: Callable[[str, ComponentConfig], Any]) -> Model:
    bodies = [
        Body(
            name=name,
            surface=make("surface", body.surface),
            material=body.material,
            wear=None if body.wear is None else make("wear_law", body.wear),
        )
        for name, body in case.bodies.items()
    ]
    return assemble(
        grid=case.grid.to_grid(),
        load=case.load.normal,
        bodies=bodies,
        contact=make("contact_solver", case.contact),
        kinematics=make("kinematics", case.kinematics),
        stepping=case.stepping,
        friction_coefficient=case.friction.coefficient if case.friction else None,
        effects=[make("effect", config) for config in case.effects],
        observers=[make("observer", config) for config in case.observers],
        save_times=case.output.save_times,
        stop=case.stop,
        ends_at_window=case.grid.ends_at_window,
        requires=case.requires,
    )
