"""The commands of `tribo`, of the kernel and of packages, through one hook."""

from __future__ import annotations

import sys
from functools import cache
from importlib import import_module

import click
import pluggy

from tribo.cli.streams import say
from tribo.core.errors import PluginError
from tribo.core.words import said
from tribo.registry import hookspecs
from tribo.registry.hookspecs import PROJECT, Command, hookimpl

OWN = {
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
    "doctor": "Test the installation and every plugin.",
}


@hookimpl
def tribo_commands() -> list[Command]:
    """Offer the commands of the kernel."""
    return [own_command(name) for name in OWN]


def own_command(name: str) -> Command:
    """Return a command of the kernel, which needs no package to be asked."""
    return Command(name, OWN[name], f"tribo.cli.{name}:{name}")


@cache
def offered() -> dict[str, Command]:
    """Return all commands by name; a package's that fail to load are left out, with a warning.

    Of the plugins those are imported that have an entry point named after their distribution.
    """
    from tribo.registry.plugins import installed

    manager = pluggy.PluginManager(PROJECT)
    manager.add_hookspecs(hookspecs)
    found: dict[str, Command] = {}
    packages = [plugin for plugin in installed() if plugin.usable and not plugin.names]
    loads = {"tribo": lambda: sys.modules[__name__]} | {str(p): p.load for p in packages}
    for whose, load in loads.items():
        try:
            module = load()
            manager.register(module)
            others = manager.get_plugins() - {module}
            (answer,) = manager.subset_hook_caller("tribo_commands", others)() or [()]
            own = {command.name: command for command in answer}
            if taken := found.keys() & own.keys():
                raise ValueError(f"there is a command {sorted(taken)[0]!r} already")
            found |= own
        except KeyboardInterrupt:
            raise
        except BaseException as error:
            say("warning", "yellow", f"the commands of {whose} are left out: {said(error)}")
    return found


def refused(package: str = "") -> list[str]:
    """Return why packages with hooks alone cannot be used: all, or the one of this name."""
    from tribo.registry.plugins import installed

    return [
        f"{plugin} is {plugin.status}: {plugin.reason}"
        for plugin in installed()
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
