"""The commonest arrangement: one body stays in contact, the other is swept."""

from __future__ import annotations

from collections.abc import Sequence

from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.motion.exposure import Exposure, Stationary


def one_swept_body(
    grid: Grid, bodies: Sequence[str], swept: str | None, exposure: Exposure
) -> dict[str, Exposure]:
    """Return `exposure` for the swept body, the last if it has no name, `Stationary` for others.

    Raises `CaseError` if there is no body of that name.
    """
    name = bodies[-1] if swept is None else swept
    if name not in bodies:
        raise CaseError(
            f"no body is called {name!r}; the bodies are {', '.join(bodies)}", "kinematics.swept"
        )
    return {b: exposure if b == name else Stationary(grid) for b in bodies}
