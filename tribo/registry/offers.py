"""What a plugin's hooks offer, held to the contract."""

from __future__ import annotations

import inspect
from collections.abc import Iterable, Iterator
from typing import Any

import pluggy

from tribo.core.fields import Field, name_fault
from tribo.core.words import did_you_mean
from tribo.interfaces.component import ComponentConfig
from tribo.registry import hookspecs
from tribo.registry.kinds import KINDS, Kind
from tribo.registry.records import ComponentRecord, Name, PluginRecord


def offers(
    plugin: object, record: PluginRecord, declared: tuple[Name, ...] | None
) -> tuple[ComponentRecord, ...]:
    """Return what the hooks of an imported plugin offer.

    Parameters
    ----------
    plugin : object
        Carries the hooks: a module, for one.
    record : PluginRecord
        What is known about it.
    declared : tuple of (str, str) or None
        Kind and name of what it must offer; None if that is free.

    Raises
    ------
    TypeError, ValueError
        If it has a hook that tribo does not know, or a hook returns something
        else than it must. Besides, whatever a hook raises.
    """
    manager = pluggy.PluginManager(hookspecs.PROJECT)
    manager.add_hookspecs(hookspecs)
    manager.register(plugin, record.entry_point)
    _check_hooks(manager, plugin)
    found = tuple(_offered(manager, record))
    if declared is not None:
        _check_declared(plugin, declared, found)
    return found


def _check_hooks(manager: pluggy.PluginManager, plugin: object) -> None:
    known = [kind.hook for kind in KINDS.values()]
    for caller in manager.get_hookcallers(plugin) or ():
        needed = not all(implementation.optionalhook for implementation in caller.get_hookimpls())
        if needed and not caller.has_spec():
            meant = did_you_mean(caller.name, known)
            hint = f"did you mean {meant!r}?" if meant else f"the hooks are {', '.join(known)}"
            raise ValueError(f"unknown hook {caller.name!r} ({hint})")


def _check_declared(
    plugin: object, declared: tuple[Name, ...], found: tuple[ComponentRecord, ...]
) -> None:
    offered = {(offer.kind, offer.name) for offer in found}
    for kind, name in sorted(set(declared) - offered):
        hook = KINDS[kind].hook
        what = f"its entry points declare the {KINDS[kind].words} {name!r}, but its hook {hook} "
        function = getattr(plugin, hook, None)
        if function is not None and not hasattr(function, f"{hookspecs.PROJECT}_impl"):
            raise ValueError(f"{what}is not marked as one; write @hookimpl above it")
        raise ValueError(f"{what}does not return it")
    for kind, name in sorted(offered - set(declared)):
        raise ValueError(
            f"its hooks return the {KINDS[kind].words} {name!r}, which no entry point of that "
            "kind declares"
        )


def _offered(manager: pluggy.PluginManager, record: PluginRecord) -> Iterator[ComponentRecord]:
    seen: set[Name] = set()
    for kind in KINDS.values():
        for implementation in getattr(manager.hook, kind.hook).get_hookimpls():
            returned = implementation.function()
            if not isinstance(returned, Iterable):
                raise TypeError(
                    f"{kind.hook} returns {returned!r}; it must return a list of classes"
                )
            for cls in returned:
                offer = ComponentRecord(kind.name, _name(cls, kind), cls, record)
                if (offer.kind, offer.name) in seen:
                    raise ValueError(f"{kind.hook} returns {offer.name!r} twice")
                seen.add((offer.kind, offer.name))
                yield offer


def _name(cls: Any, kind: Kind) -> str:
    """Return the name of `cls` in a case; raise TypeError if it is not of this kind."""
    shown = getattr(cls, "__qualname__", repr(cls))
    if not (inspect.isclass(cls) and issubclass(cls, kind.interface)):
        raise TypeError(
            f"{kind.hook} returns {shown}, not a subclass of tribo.plugin.{kind.interface.__name__}"
        )
    if inspect.isabstract(cls):
        missing = ", ".join(sorted(cls.__abstractmethods__))
        raise TypeError(f"{shown} does not define {missing}")
    config = getattr(cls, "Config", None)
    if not (inspect.isclass(config) and issubclass(config, ComponentConfig)):
        raise TypeError(f"{shown}.Config is not a subclass of tribo.plugin.ComponentConfig")
    _check_declarations(cls, kind, shown)
    name = config.model_fields["type"].default
    if not (isinstance(name, str) and name):
        raise TypeError(f'{config.__qualname__} needs a line: type: Literal["NAME"] = "NAME"')
    return name


def _check_declarations(cls: type, kind: Kind, shown: str) -> None:
    """Raise TypeError unless what a class declares of fields is declared as it must be."""
    needed = 'a tuple of Field, as in (Field("name", "m", "What it means."),)'
    for attribute in ("state_fields", "provides"):
        if attribute in kind.interface.__annotations__ and not hasattr(cls, attribute):
            raise TypeError(f"{shown} does not define {attribute}, {needed}")
        fields = getattr(cls, attribute, ())
        if not (isinstance(fields, tuple | list) and all(isinstance(f, Field) for f in fields)):
            raise TypeError(f"{shown}.{attribute} is {fields!r}; it must be {needed}")
        if fault := name_fault(fields):
            raise TypeError(f"{shown}.{attribute}: {fault}")
    names = getattr(cls, "requires", ())
    if not (isinstance(names, tuple | list) and all(isinstance(name, str) for name in names)):
        raise TypeError(
            f'{shown}.requires is {names!r}; it must be a tuple of names, as in ("temperature",)'
        )
