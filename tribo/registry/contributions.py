"""Lab rows, figures, export formats and case templates of plugins."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from tribo.core.errors import CaseError, TriboWarning
from tribo.core.words import did_you_mean, suggestion
from tribo.registry.registry import default_registry

if TYPE_CHECKING:
    from tribo.lab.heights import Heights
    from tribo.result.read import Result


class LabRow(NamedTuple):
    """A row of the table after a run: its label, its value and the unit of the value."""

    label: str
    value: float
    unit: str


class ExportFormat(NamedTuple):
    """A format of `tribo export`: its name, what it holds, and a function that writes it."""

    name: str
    summary: str
    write: Callable[[Result, Path], Iterable[Path]]


class HeightFormat(NamedTuple):
    """A format of measured height maps: its name, what it holds, and a function that reads it."""

    name: str
    summary: str
    read: Callable[[Path], Heights]


class CaseTemplate(NamedTuple):
    """A case of `tribo new`: its name, what it is, and its text, in TOML."""

    name: str
    summary: str
    text: str


def choose(hook: str, name: str, words: str) -> Any:
    """Return the format or template of this name; imports every plugin.

    Parameters
    ----------
    hook : str
        The hook by which plugins offer it.
    name : str
        Its name.
    words : str
        What it is, for the message: ``"format"`` or ``"template"``.

    Raises
    ------
    CaseError
        If no plugin offers it.
    """
    registry = default_registry()
    for plugin in registry.load_all():
        warnings.warn(f"{plugin} is left out: {plugin.reason}", TriboWarning, stacklevel=3)
    known = {each.name: each for answer in registry.ask(hook) for each in answer}
    if name not in known:
        listed = "; ".join(f"{each.name} ({each.summary.rstrip('.')})" for each in known.values())
        meant = suggestion(did_you_mean(name, known))
        raise CaseError(f"no {words} is called {name!r}{meant} Known: {listed}")
    return known[name]


def from_plugins_of(result: Result, hook: str) -> list[Any]:
    """Return the answers to a hook about a result, of the plugins whose models it names.

    Those that are not installed are left out.
    """
    registry = default_registry()
    for made in result.provenance["components"].values():
        with suppress(CaseError):
            registry.find(str(made["type"]))
    return registry.ask(hook, result=result)
