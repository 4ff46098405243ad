"""The file of a study: a base case, what varies in it, and the resulting points."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field, ValidationError

from tribo.config.load import case_tables, read_toml
from tribo.config.overrides import apply_settings
from tribo.core.errors import CaseError
from tribo.core.explain import case_error
from tribo.core.table import Table
from tribo.core.toml import inline
from tribo.study.variation import Point, check_distinct

Values = Annotated[tuple[Any, ...], Field(min_length=1)]
_VARIED = {"load.normal": ["50 N", "100 N"]}


class Study(Table):
    """A base case and what varies in it; each table adds a factor to the number of runs."""

    case: str
    """File of the base case; relative to the study's."""
    settings: dict[str, Any] = Field(default_factory=dict)
    """Changes to the base case, by path."""
    grid: dict[str, Values] = Field(default_factory=dict)
    """Values by path; every combination is run."""
    zip: dict[str, Values] = Field(default_factory=dict)
    """Values by path, equally many; the first of each together, then the second, …"""
    list: tuple[dict[str, Any], ...] = ()
    """Points one by one, each a table of values by path."""


def load_study(path: str | Path | Mapping[str, Any]) -> tuple[Study, dict[str, Any]]:
    """Read the file of a study; return it, and the tables of its base case with its settings.

    Of the tables of a study the case may be a `Case`, or its tables.
    """
    if isinstance(path, Mapping):
        case = path.get("case", "")
        given = case if isinstance(case, str | Path) else "a case"
        study = _validated({**path, "case": str(given)}, repr({"grid": _VARIED}))
        return study, apply_settings(case_tables(case), study.settings)
    path = Path(path)
    tables = read_toml(path, "a study", "'tribo new sweep' writes a study to start from")
    if "bodies" in tables and "case" not in tables:
        raise CaseError(
            f"{path} is a case, not a study, which names a case and says what varies in it; begin "
            "one with: tribo new sweep study.toml"
        )
    study = _validated(tables, f"grid = {inline(_VARIED)}")
    try:
        base = read_toml(path.parent / study.case)
    except CaseError as error:
        raise CaseError(str(error), "case") from None
    return study, apply_settings(base, study.settings)


def _validated(data: dict[str, Any], example: str) -> Study:
    for key in ("settings", "grid", "zip"):
        if key in data:
            data[key] = by_path(data[key], key)
    if isinstance(data.get("list"), list):
        data["list"] = [by_path(point, f"list.{i}") for i, point in enumerate(data["list"], 1)]
    try:
        study = Study.model_validate(data)
    except ValidationError as error:
        raise case_error(error) from None
    if not (study.grid or study.zip or study.list):
        raise CaseError(f"nothing varies; give grid, zip or list, as {example}")
    return study


def points(study: Study) -> list[Point]:
    """Return the settings of every run; what is listed last varies first.

    CaseError if the study contradicts itself.
    """
    listed = dict.fromkeys(path for point in study.list for path in point)
    check_distinct([*listed, *study.zip, *study.grid])
    lengths = {path: len(values) for path, values in study.zip.items()}
    if len(set(lengths.values())) > 1:
        given = ", ".join(f"{path} has {length}" for path, length in lengths.items())
        raise CaseError(f"values that go together must be equally many: {given}", "zip")
    zipped = [
        dict(zip(study.zip, row, strict=True)) for row in zip(*study.zip.values(), strict=True)
    ]
    axes = [[{path: value} for value in values] for path, values in study.grid.items()]
    blocks = [block for block in (list(study.list), zipped, *axes) if block]
    return [
        {path: value for part in parts for path, value in part.items()}
        for parts in product(*blocks)
    ]


def by_path(table: Any, where: str, prefix: str = "") -> Any:
    """Return values by path; a path may be a quoted key, or tables in each other."""
    if not isinstance(table, Mapping):
        return table
    found: dict[str, Any] = {}
    for key, value in table.items():
        path = f"{prefix}{key}"
        nested = isinstance(value, Mapping) and value
        for name, item in (by_path(value, where, f"{path}.") if nested else {path: value}).items():
            if name in found:
                raise CaseError(f"{name!r} is given twice", where)
            found[name] = item
    return found
