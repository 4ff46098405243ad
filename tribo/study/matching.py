"""Match the bodies of two results by name, role or order."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from tribo.core.errors import CaseError
from tribo.result.hdf5 import renamed_image
from tribo.result.read import Result


def check_match(match: Mapping[str, str], first: Result, others: Sequence[Result]) -> None:
    """Check that `match` pairs bodies of the first result with bodies of others, each once."""
    theirs = dict.fromkeys(name for result in others for name in result.body_names)
    known = match.keys() <= {*first.body_names} and theirs.keys() >= {*match.values()}
    if not known or len({*match.values()}) < len(match):
        given = ", ".join(f"{name}={own}" for name, own in match.items())
        raise CaseError(
            f"{given} does not pair a body of the first result ({', '.join(first.body_names)}) "
            f"with one of another ({', '.join(theirs)}), each once at most; write it as "
            f"{first.body_names[0]}={next(iter(theirs))}",
            "match",
        )


def pairs(first: Result, other: Result, match: Mapping[str, str]) -> dict[str, str]:
    """Return the names of another result's bodies by the names of their matches in the first.

    A body matches the body that `match` states, else the body of the same name,
    else of the same role, swept or not, else the next in order.
    """

    def likeness(names: dict[str, str]) -> tuple[int, ...]:
        said = [match.get(name) == own for name, own in names.items()]
        same = [name == own for name, own in names.items()]
        roles = [first.body(name).swept == other.body(own).swept for name, own in names.items()]
        return sum(said), sum(same), sum(roles)

    own = other.body_names
    straight, crossed = (
        dict(zip(first.body_names, names, strict=True)) for names in (own, own[::-1])
    )
    return crossed if likeness(crossed) > likeness(straight) else straight


def renamed(result: Result, names: Mapping[str, str]) -> Result:
    """Return a copy in memory whose bodies go by other names; `names` has the old by the new."""
    new = {own: name for name, own in names.items()}
    return Result(renamed_image(result.image(), new), result.name)
