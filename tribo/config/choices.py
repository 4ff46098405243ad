"""The configurations that the slots of a schema may take."""

from __future__ import annotations

import json
import warnings
from contextvars import ContextVar
from typing import Literal

from pydantic import BaseModel

from tribo.component import Component
from tribo.core.errors import TriboWarning
from tribo.core.words import said
from tribo.registry.kinds import KINDS
from tribo.registry.registry import Registry

Mode = Literal["validation", "serialization"]
Configs = dict[str, type[Component]]

trying: ContextVar[bool] = ContextVar("trying", default=False)
"""Whether the schema of one configuration is tried, in which slots are of no interest."""


class Choices:
    """The configurations of each kind by name, found once for a schema.

    One that cannot be imported, or whose own schema cannot be made, is left
    out and warned of, once.

    Parameters
    ----------
    registry : Registry
        Where they come from.
    mode : str
        What the schema is of: ``"validation"`` or ``"serialization"``.
    """

    def __init__(self, registry: Registry, mode: Mode) -> None:
        self._registry = registry
        self._mode = mode
        self._found: dict[str, Configs] = {}
        self._told: set[str] = set()

    def of(self, kind: str) -> Configs:
        """Return the configurations of a kind."""
        if kind not in self._found:
            for plugin in self._registry.load_all():
                self._warn(f"{plugin} is left out: {plugin.reason}")
            configs = {name: self._config(kind, name) for name in self._registry.names(kind)}
            self._found[kind] = {name: config for name, config in configs.items() if config}
        return self._found[kind]

    def _config(self, kind: str, name: str) -> type[Component] | None:
        cls = self._registry.lookup(kind, name)
        fault = _fault(cls, self._mode)
        if fault:
            (plugin,) = self._registry.claimants(name)
            self._warn(
                f"{KINDS[kind].words} {name!r} of {plugin} is left out: making the schema of its "
                f"configuration raised {fault}"
            )
            return None
        return cls

    def _warn(self, message: str) -> None:
        if message not in self._told:
            self._told.add(message)
            warnings.warn(message, TriboWarning, stacklevel=2)


def _fault(config: type[BaseModel], mode: Mode) -> str:
    """Return what making the schema of a configuration raises; empty if nothing."""
    token = trying.set(True)
    try:
        json.dumps(config.model_json_schema(mode=mode), allow_nan=False)
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        return said(error)
    finally:
        trying.reset(token)
    return ""
