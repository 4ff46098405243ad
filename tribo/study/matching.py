"""Which body of one result is which of another, whatever they are called."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.result.body import BodyResult
from tribo.result.read import Result


class Renamed(Result):
    """A result whose bodies go by other names; `names` has its own by those."""

    def __init__(self, result: Result, names: Mapping[str, str]) -> None:
        self.__dict__.update(vars(result))
        self.result = result
        self.names = names

    @property
    def body_names(self) -> tuple[str, ...]:
        """Names that the bodies go by."""
        return tuple(self.names)

    def field(self, name: str, save: int, body: str | None = None) -> Array:
        """Return a field at a save; see `Result.field`."""
        if body is not None:
            self._check_body(body)
            body = self.names[body]
        return self.result.field(name, save, body)

    def body(self, name: str) -> BodyResult:
        """Return what is kept of a body; see `Result.body`."""
        self._check_body(name)
        return replace(self.result.body(self.names[name]), name=name)

    def table(self, name: str) -> dict[str, Array]:
        """Return a table as columns; see `Result.table`."""
        shown = {own: name for name, own in self.names.items()}
        columns = {}
        for column, values in self.result.table(name).items():
            of, *rest = column.split(".", 2)
            if of == "bodies":
                column = f"bodies.{shown[rest[0]]}.{rest[1]}"
            columns[column] = values
        return columns


def own_names(result: Result) -> dict[str, str]:
    """Return what the bodies of a result are called in its file, by the names they go by."""
    return dict(result.names) if isinstance(result, Renamed) else {n: n for n in result.body_names}


def matched(results: Mapping[str, Result], match: Mapping[str, str]) -> dict[str, Result]:
    """Return results whose two bodies go by the names that they have in the first.

    A body is that which `match` says, else that of the same name, else that of
    the same role, swept or not, else the next in order. CaseError if `match`
    names a body that there is not, or one twice.
    """
    found = dict(results)
    if len(results) > 1:
        first, *others = results.values()
        _check(match, first, others)
        for label, result in list(results.items())[1:]:
            names = _pairs(first, result, match)
            if any(name != own for name, own in names.items()):
                found[label] = Renamed(result, names)
    return found


def _check(match: Mapping[str, str], first: Result, others: Sequence[Result]) -> None:
    theirs = dict.fromkeys(name for result in others for name in result.body_names)
    for name, own in match.items():
        if name not in first.body_names:
            known = ", ".join(first.body_names)
            raise CaseError(
                f"the first result has no body {name!r}; its bodies are {known}", "match"
            )
        if own not in theirs:
            known = ", ".join(theirs)
            raise CaseError(f"no other result has a body {own!r}; theirs are {known}", "match")
        if list(match.values()).count(own) > 1:
            raise CaseError(f"{own!r} cannot be two bodies of the first result", "match")


def _pairs(first: Result, result: Result, match: Mapping[str, str]) -> dict[str, str]:
    """Return names in `result` by those in `first`."""

    def likeness(pairs: dict[str, str]) -> tuple[int, ...]:
        roles = [first.body(name).swept == result.body(own).swept for name, own in pairs.items()]
        said = [match.get(name) == own for name, own in pairs.items()]
        return sum(said), sum(name == own for name, own in pairs.items()), sum(roles)

    own = result.body_names
    straight, crossed = (
        dict(zip(first.body_names, names, strict=True)) for names in (own, own[::-1])
    )
    return crossed if likeness(crossed) > likeness(straight) else straight
