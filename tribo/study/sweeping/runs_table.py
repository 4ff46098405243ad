"""Tables of a sweep, read off its results: a row a run, and a row a save."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, get_args

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from tribo.case import Case
from tribo.component import Component
from tribo.config.overrides import path_keys
from tribo.core.errors import CaseError, OutputError
from tribo.core.units import Quantity
from tribo.lab.report import lab_report
from tribo.result.columns import labelled
from tribo.result.read import Result
from tribo.study.sweeping.worker import failure_path

Row = dict[str, Any]
LAST = ("file", "message")
"""Columns at the end."""


@dataclass(frozen=True)
class Run:
    """A run of a sweep.

    Parameters
    ----------
    number : int
        Counted from 1, in the order of the study.
    label : str
        Its settings in words.
    case : Case
        The whole case.
    path : Path
        Its result file.
    """

    number: int
    label: str
    case: Case
    path: Path


@dataclass(frozen=True)
class Outcome:
    """How a run stands.

    Parameters
    ----------
    status : str
        ``"done"``, ``"failed"``, ``"interrupted"`` or ``"waiting"``.
    message : str
        Why it failed, or what it warned of.
    """

    status: str
    message: str = ""


def outcome(run: Run) -> Outcome:
    """Return how a run stands, from its files alone."""
    failure = failure_path(run.path)
    if failure.exists():
        return Outcome("failed", failure.read_text(encoding="utf-8").strip())
    if not run.path.exists():
        return Outcome("waiting")
    try:
        with Result.open(run.path) as result:
            result.check()
            status = "done" if result.status == "done" else "interrupted"
            return Outcome(status, "; ".join(result.notices))
    except CaseError as error:
        return Outcome("interrupted", str(error))


def varied(run: Run, paths: Sequence[str]) -> Row:
    """Return the values at `paths` in a run, in SI, by path and unit.

    A table or list gives a value for each that is in it.
    """
    row: Row = {}
    for path in paths:
        for name, value, unit in _leaves("", run.case, None, path_keys(path)):
            row[labelled(name, unit)] = value
    return row


def runs_table(runs: Sequence[Run], paths: Sequence[str]) -> list[Row]:
    """Return a row for each run: its settings, how it stands, and what a lab would report."""
    rows = []
    for run in runs:
        state = outcome(run)
        row: Row = {"run": run.number, "status": state.status, **varied(run, paths)}
        if state.status == "done":
            row |= _measured(run.path)
        rows.append(row | {"file": run.path.name, "message": state.message})
    return rows


def saves_table(runs: Sequence[Run], paths: Sequence[str]) -> list[Row]:
    """Return a row for each save of the runs that are done."""
    rows = []
    for run in runs:
        if outcome(run).status != "done":
            continue
        begin: Row = {"run": run.number, **varied(run, paths)}
        with Result.open(run.path) as result:
            table = result.table("saves")
            rows += [
                {**begin, "save": i, **{name: float(values[i]) for name, values in table.items()}}
                for i in range(len(result.times))
            ]
    return rows


def write_csv(path: Path, rows: Sequence[Row]) -> None:
    """Write rows as CSV, all at once; what a row lacks is left empty.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    names = {name: None for row in rows for name, value in row.items() if value is not None}
    header = [
        *(name for name in names if name not in LAST),
        *(name for name in LAST if name in names),
    ]
    fresh = path.with_name(path.name + ".new")
    try:
        with fresh.open("w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, header, extrasaction="ignore")
            writer.writeheader()
            writer.writerows(rows)
        fresh.replace(path)
    except OSError as error:
        raise OutputError(f"cannot write {path}: {error.strerror}") from error


def _measured(path: Path) -> Row:
    """Return the scalars of the last save, and what a lab would report."""
    with Result.open(path) as result:
        row: Row = {name: float(values[-1]) for name, values in result.table("saves").items()}
        lab = lab_report(result).as_json()
        totals = result.totals()
    for name, body in lab["bodies"].items():
        row |= {f"bodies.{name}.{label}": value for label, value in body.items()}
    row |= {f"first_contact.{label}": value for label, value in lab["first_contact"].items()}
    return row | {"steps": totals["steps"], "wall_time_s": totals["wall_time_s"]}


def _leaves(
    name: str, value: Any, field: FieldInfo | None, keys: Sequence[str]
) -> Iterator[tuple[str, Any, str]]:
    """Yield name, value and unit of all that lies at `keys` in a table; nothing if none does."""
    inside: Mapping[Any, Any] | None = None
    if isinstance(value, BaseModel):
        inside = dict(value)
        if isinstance(value, Component):
            inside = {"type": value.type, **inside}
    elif isinstance(value, Mapping):
        inside = value
    elif isinstance(value, list | tuple):
        inside = {str(i): item for i, item in enumerate(value)}
    if inside is None:
        if not keys:
            yield name, value, _unit(field)
        return
    for key, item in inside.items():
        if keys and key != keys[0]:
            continue
        under = type(value).model_fields.get(key) if isinstance(value, BaseModel) else field
        yield from _leaves(f"{name}.{key}" if name else key, item, under, keys[1:])


def _unit(field: FieldInfo | None) -> str:
    """Return the unit of a field, or of what a list or an optional field holds."""
    if field is None:
        return "1"
    return next((mark.unit for mark in _marks(field.annotation, field.metadata)), "1")


def _marks(annotation: Any, metadata: Sequence[Any]) -> Iterator[Quantity]:
    yield from (mark for mark in metadata if isinstance(mark, Quantity))
    for part in get_args(annotation):
        yield from _marks(part, getattr(part, "__metadata__", ()))
