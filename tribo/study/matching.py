"""Which body of one result is which of another, whatever they are called."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from tribo.core.arrays import Array
from tribo.core.errors import CaseError
from tribo.result.body import BodyResult
from tribo.result.read import Result


class Renamed(Result):
    """A result whose bodies go by other names; those without one are left out.

    Parameters
    ----------
    result : Result
        What is read; `close` closes it.
    names : Mapping
        The bodies' names in `result`, by the names they go by.
    """

    def __init__(self, result: Result, names: Mapping[str, str]) -> None:
        super().__init__(result._file)
        self.result = result
        self.names = names

    @property
    def body_names(self) -> tuple[str, ...]:
        """Names that the bodies go by."""
        return tuple(self.names)

    def wear_depth(self, body: str, save: int) -> Array:
        """Return the worn depth of a body; see `Result.wear_depth`."""
        self._check_body(body)
        return self.result.wear_depth(self.names[body], save)

    def body(self, name: str) -> BodyResult:
        """Return what is kept of a body; see `Result.body`."""
        self._check_body(name)
        return replace(self.result.body(self.names[name]), name=name)

    def table(self, name: str) -> dict[str, Array]:
        """Return a table as columns; see `Result.table`."""
        table = self.result.table(name)
        columns = {c: values for c, values in table.items() if not c.startswith("bodies.")}
        for shown, own in self.names.items():
            before = f"bodies.{own}."
            columns |= {
                f"bodies.{shown}.{column.removeprefix(before)}": values
                for column, values in table.items()
                if column.startswith(before)
            }
        return columns


def own_names(result: Result) -> dict[str, str]:
    """Return what the bodies of a result are called in its file, by the names they go by."""
    return dict(result.names) if isinstance(result, Renamed) else {n: n for n in result.body_names}


def left_out(result: Result) -> list[str]:
    """Return the bodies in the file of a result that go by no name."""
    if not isinstance(result, Renamed):
        return []
    return [name for name in result.result.body_names if name not in result.names.values()]


def matched(results: Mapping[str, Result], match: Mapping[str, str]) -> dict[str, Result]:
    """Return results whose bodies go by the names that they have in the first.

    A body is that which `match` says, else that of the same name, else the
    next that is left of the same role, swept or not, else the next left.

    Parameters
    ----------
    results : Mapping
        The open results by label; the first one's names count.
    match : Mapping
        Names in other results, by names in the first.

    Raises
    ------
    CaseError
        If `match` names a body that there is not, or one twice.
    """
    labels = list(results)
    first, *others = results.values()
    _check(match, first, others)
    found = {labels[0]: first}
    for label, result in zip(labels[1:], others, strict=True):
        if not match and set(result.body_names) == set(first.body_names):
            found[label] = result
        else:
            found[label] = Renamed(result, _counterparts(result, first, match))
    return found


def _check(match: Mapping[str, str], first: Result, others: Sequence[Result]) -> None:
    theirs = dict.fromkeys(name for result in others for name in result.body_names)
    for name, own in match.items():
        if name not in first.body_names:
            raise CaseError(
                f"the first result has no body {name!r}; its bodies are "
                + ", ".join(first.body_names),
                "match",
            )
        if own not in theirs:
            raise CaseError(
                f"no other result has a body {own!r}; theirs are {', '.join(theirs)}", "match"
            )
    twice = [own for own, count in Counter(match.values()).items() if count > 1]
    if twice:
        raise CaseError(f"{twice[0]!r} cannot be two bodies of the first result", "match")


def _counterparts(result: Result, first: Result, match: Mapping[str, str]) -> dict[str, str]:
    """Return names in `result` by those in `first`, in the order of `first`."""
    roles = {name: first.body(name).swept for name in first.body_names}
    own_roles = {name: result.body(name).swept for name in result.body_names}
    alike: tuple[Callable[[str, str], bool], ...] = (
        lambda name, own: match.get(name) == own,
        lambda name, own: name == own,
        lambda name, own: roles[name] == own_roles[own],
        lambda name, own: True,
    )
    found: dict[str, str] = {}
    for same in alike:
        for name in roles:
            left = (own for own in own_roles if own not in found.values() and same(name, own))
            if name not in found and (own := next(left, None)) is not None:
                found[name] = own
    return {name: found[name] for name in roles if name in found}
