"""What is known about a plugin, and about a component it offers."""

from __future__ import annotations

from dataclasses import dataclass
from inspect import cleandoc
from typing import Literal

from tribo.interfaces.component import Component

Name = tuple[str, str]
"""Kind and name of a component."""

Status = Literal["available", "loaded", "disabled", "broken", "incompatible", "conflict"]


@dataclass(frozen=True)
class PluginRecord:
    """A plugin, whether or not it could be loaded.

    Parameters
    ----------
    distribution : str
        The distribution it came with.
    version : str
        Version of the distribution; empty if it states none.
    entry_point : str
        The module it lies in, as ``"acme_tribo.plugin"``.
    origin : str
        How it was found: ``"built-in"``, ``"installed"`` or ``"given"``.
    status : str
        ``available`` (not imported yet), ``loaded``, ``disabled`` by the user,
        ``broken`` (it raised, or does not hold to the contract),
        ``incompatible`` (made for another version of the interfaces) or
        ``conflict`` (it claims a name that another plugin claims too).
    reason : str
        Why it cannot be used; empty if it can.
    """

    distribution: str
    version: str
    entry_point: str
    origin: Literal["built-in", "installed", "given"]
    status: Status = "loaded"
    reason: str = ""

    def __str__(self) -> str:
        return f"{self.distribution} {self.version}".rstrip()

    @property
    def usable(self) -> bool:
        """Whether anything of it can be used, as far as is known."""
        return self.status not in ("disabled", "broken", "incompatible")


@dataclass(frozen=True)
class ComponentRecord:
    """A component and the plugin that offers it.

    Parameters
    ----------
    kind : str
        Its kind, as ``"wear_law"``.
    name : str
        Its name in a case, as ``"archard"``.
    cls : type
        The class.
    plugin : PluginRecord
        Who offers it.
    """

    kind: str
    name: str
    cls: type[Component]
    plugin: PluginRecord

    @property
    def description(self) -> str:
        """The docstring of the class; empty where it has none, or one that is no text."""
        text = self.cls.__doc__
        return cleandoc(text) if isinstance(text, str) else ""
