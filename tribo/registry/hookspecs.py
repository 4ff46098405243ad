"""The hooks by which a plugin offers its classes: the whole plugin surface."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import pluggy

if TYPE_CHECKING:
    from tribo.interfaces.contact import ContactSolver
    from tribo.interfaces.effect import Effect
    from tribo.interfaces.kinematics import Kinematics
    from tribo.interfaces.observer import Observer
    from tribo.interfaces.surface import Surface
    from tribo.interfaces.wear import WearLaw

PROJECT = "tribo"

hookspec = pluggy.HookspecMarker(PROJECT)
hookimpl = pluggy.HookimplMarker(PROJECT)
"""Marks a function of a plugin as the implementation of the hook it is named after."""


@hookspec
def tribo_contact_solvers() -> Iterable[type[ContactSolver]]:
    """Return the contact solvers that this plugin offers."""
    return ()


@hookspec
def tribo_wear_laws() -> Iterable[type[WearLaw]]:
    """Return the wear laws that this plugin offers."""
    return ()


@hookspec
def tribo_kinematics() -> Iterable[type[Kinematics]]:
    """Return the motions that this plugin offers."""
    return ()


@hookspec
def tribo_surfaces() -> Iterable[type[Surface]]:
    """Return the surfaces that this plugin offers."""
    return ()


@hookspec
def tribo_effects() -> Iterable[type[Effect]]:
    """Return the effects that this plugin offers."""
    return ()


@hookspec
def tribo_observers() -> Iterable[type[Observer]]:
    """Return the observers that this plugin offers."""
    return ()
