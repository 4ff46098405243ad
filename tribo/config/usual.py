"""Values that are possible but so far from the usual that a unit is more likely forgotten."""

from __future__ import annotations

from pydantic import BaseModel

from tribo.config.overrides import leaves


def unusual(case: BaseModel) -> list[str]:
    """Ask about each quantity that is out of its usual range.

    Parameters
    ----------
    case : BaseModel
        A case, or a table of it.

    Returns
    -------
    list of str
        As ``"bodies.ball.surface.radius is 5 m, usual are 1e-09 to 1 m: a unit
        forgotten, as in '5 mm'?"``.
    """
    found = []
    for place, value, mark in leaves(case):
        doubt = mark.doubt(value) if mark and isinstance(value, float) else None
        if doubt is not None:
            while isinstance(place[-1], int):
                # Both of a pair written as one value are the same.
                place = place[:-1]
            found.append(f"{_joined(place)} is {doubt}")
    return list(dict.fromkeys(found))


def _joined(place: tuple[str | int, ...]) -> str:
    text = "".join(f"[{key}]" if isinstance(key, int) else f".{key}" for key in place)
    return text.removeprefix(".")
