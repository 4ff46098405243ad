"""Call into a component, so that whatever goes wrong there names it."""

from __future__ import annotations

from types import TracebackType

from tribo.component import Component
from tribo.core.errors import Interrupted, NumericalError, PluginError, TriboError
from tribo.core.words import said
from tribo.registry.kinds import KINDS

Called = Component | type[Component]


class named:  # noqa: N801
    """How messages call a component, as ``wear law 'archard' of body 'ball'``.

    It becomes text only where a message is made.
    """

    __slots__ = ("_body", "_component")

    def __init__(self, component: Called, body: str | None = None) -> None:
        self._component = component
        self._body = body

    def __str__(self) -> str:
        component, body = self._component, self._body
        cls = component if isinstance(component, type) else type(component)
        words = next(kind.words for kind in KINDS.values() if issubclass(cls, kind.interface))
        return f"{words} {cls.type!r}" + (f" of body {body!r}" if body else "")


class calling:  # noqa: N801
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

    # A generator with `contextmanager` takes four times as long, at every call of a component.
    __slots__ = ("_who",)

    def __init__(self, component: Called, body: str | None = None) -> None:
        self._who = named(component, body)

    def __enter__(self) -> None:
        return

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        if error is None or isinstance(error, KeyboardInterrupt | Interrupted | PluginError):
            return
        if isinstance(error, TriboError) and str(error).strip():
            if isinstance(error, NumericalError):
                raise NumericalError(f"{self._who}: {error}") from error
            return
        if isinstance(error, MemoryError):
            raise NumericalError(f"{self._who} ran out of memory; lower grid.cells") from error
        raise PluginError(
            f"{self._who} raised {said(error)}; this is a fault of that component (TRIBO_DEBUG=1 "
            "shows where)"
        ) from error
