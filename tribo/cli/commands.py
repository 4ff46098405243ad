"""The commands of `tribo`, of the kernel and of packages, through one hook."""

from __future__ import annotations

import sys
from functools import cache
from importlib import import_module

import click

from tribo.core.errors import PluginError, warn
from tribo.core.words import said
from tribo.registry.hookspecs import Command, hookimpl

_SUMMARIES = {
    "demo": "Run the paper's one-hour test.",
    "new": "Write a case file to start from.",
    "check": "Validate a case and predict what it will do.",
    "run": "Run a case.",
    "sweep": "Run many variants of a case in parallel.",
    "resume": "Go on with a run that was stopped.",
    "compare": "Run variants of a case, or take results, side by side.",
    "show": "Print a result as a table or as JSON.",
    "plot": "Draw the pictures of a result.",
    "export": "Write tables as CSV or for Excel.",
    "materials": "List the materials that a case may name.",
    "plugins": "List, show, check and begin plugins.",
    "verify": "Compare with closed forms and other codes; find the errors of a case.",
    "doctor": "Print versions, and try every plugin.",
}
OWN = {name: Command(name, what, f"tribo.cli.{name}:{name}") for name, what in _SUMMARIES.items()}
"""The commands of the kernel, by name."""


@hookimpl(trylast=True)
def tribo_commands() -> list[Command]:
    """Offer the commands of the kernel."""
    return [*OWN.values()]


@cache
def offered() -> dict[str, Command]:
    """Return all commands by name; a package's that fail to load are left out, with a warning.

    Of the plugins those are imported that have an entry point named after their distribution.
    """
    from tribo.registry.registry import default_registry, from_packages

    found: dict[str, Command] = {}
    for command in from_packages("tribo_commands", sys.modules[__name__]):
        if found.setdefault(command.name, command) is not command:
            warn(f"{command.place} is left out: there is a command {command.name!r} already")
    for plugin in default_registry().plugins:
        if plugin.status == "broken" and not plugin.names:
            warn(f"the commands of {plugin} are left out: {plugin.reason}")
    return found


def refused(package: str = "") -> list[str]:
    """Return why packages with hooks alone cannot be used: all, or the one of this name."""
    from tribo.registry.registry import default_registry

    return [
        f"{plugin} is {plugin.status}: {plugin.reason}"
        for plugin in default_registry().plugins
        if not (plugin.usable or plugin.names) and package in ("", plugin.distribution)
    ]


def imported(command: Command) -> click.Command:
    """Import a command.

    Raises
    ------
    PluginError
        If its module cannot be imported, or holds no such command.
    """
    module, _, attribute = command.place.partition(":")
    try:
        found = getattr(import_module(module), attribute)
    except Exception as error:
        raise PluginError(f"tribo {command.name}: {command.place} raised {said(error)}") from error
    if not isinstance(found, click.Command):
        raise PluginError(f"tribo {command.name}: {command.place} is no command of click")
    return found
