"""Name the component in which an unexpected error arose."""

from __future__ import annotations

import traceback
from collections.abc import Iterator
from contextlib import contextmanager

from tribo.core.errors import PluginError, TriboError
from tribo.interfaces.component import Component
from tribo.interfaces.exposure import Exposure


@contextmanager
def blaming() -> Iterator[None]:
    """Turn whatever a component raises into a `PluginError` that names it.

    The component is found as the innermost ``self`` on the way of the error;
    one that no component is on the way of is passed on as it is.
    """
    try:
        yield
    except (TriboError, KeyboardInterrupt, GeneratorExit):
        raise
    except BaseException as error:
        culprit = _culprit(error)
        if culprit is None:
            raise
        text = " ".join(str(error).split())
        raise PluginError(
            f"{culprit} raised {type(error).__name__}: {text}; this is a fault of that component "
            "(TRIBO_DEBUG=1 shows where)"
        ) from error


def _culprit(error: BaseException) -> str | None:
    found = None
    for frame, _ in traceback.walk_tb(error.__traceback__):
        owner = frame.f_locals.get("self")
        where = f"{type(owner).__module__}.{type(owner).__qualname__}"
        if isinstance(owner, Component):
            found = f"{owner.type_name()!r} ({where})"
        elif isinstance(owner, Exposure):
            found = f"exposure {where}"
    return found
