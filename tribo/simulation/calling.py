"""Call into a component, so that whatever goes wrong there names it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from tribo.core.errors import Interrupted, NumericalError, PluginError, TriboError
from tribo.core.words import said
from tribo.interfaces.component import Component
from tribo.registry.kinds import KINDS

Called = Component[Any] | type[Component[Any]]


def named(component: Called, body: str | None = None) -> str:
    """Return how messages call a component, as ``wear law 'archard' of body 'ball'``."""
    cls = component if isinstance(component, type) else type(component)
    words = next(kind.words for kind in KINDS.values() if issubclass(cls, kind.interface))
    return f"{words} {cls.type_name()!r}" + (f" of body {body!r}" if body else "")


@contextmanager
def calling(component: Called, body: str | None = None) -> Iterator[None]:
    """Let nothing but an error that names `component` come out of a call to it.

    Parameters
    ----------
    component : Component or type
        What is called; its class where that is made.
    body : str, optional
        The body it belongs to, if it belongs to one.

    Raises
    ------
    PluginError
        If it raises what nobody expects, or an error without a message.
    NumericalError
        If it raises one, or there is no more memory.
    """
    try:
        yield
    except (KeyboardInterrupt, Interrupted, PluginError):
        raise
    except BaseException as error:
        who = named(component, body)
        if isinstance(error, TriboError) and str(error).strip():
            if isinstance(error, NumericalError):
                raise NumericalError(f"{who}: {error}") from error
            raise
        if isinstance(error, MemoryError):
            raise NumericalError(f"{who} ran out of memory; lower grid.cells") from error
        raise PluginError(
            f"{who} raised {said(error)}; this is a fault of that component (TRIBO_DEBUG=1 shows "
            "where)"
        ) from error
