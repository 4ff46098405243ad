"""The file of a study: a base case and what varies in it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, ValidationError

from tribo.config.load import read_toml
from tribo.config.overrides import apply_settings
from tribo.core.errors import CaseError
from tribo.core.explain import case_error
from tribo.core.table import Table

Values = Annotated[tuple[Any, ...], Field(min_length=1)]
_RANGE = frozenset({"low", "high"})


class RangeConfig(Table):
    """A range of a quantity."""

    low: Any
    """Lower end, as the case would have it: a number, or text with a unit."""
    high: Any
    """Upper end."""
    scale: Literal["linear", "log"] = "linear"
    """Whether values or their logarithms are spread evenly."""


class SampleConfig(Table):
    """Points that fill a box of ranges."""

    method: Literal["latin_hypercube", "sobol"]
    """How they are spread."""
    count: Annotated[int, Field(ge=1)]
    """How many; a power of two for `sobol`."""
    seed: Annotated[int, Field(ge=0)] = 0
    """Another seed gives other points, the same one always the same."""
    ranges: dict[str, RangeConfig] = Field(min_length=1)
    """The range of each value, by its path in the case."""


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
    sample: SampleConfig | None = None
    """Points in a box of ranges."""


def load_study(path: str | Path) -> tuple[Study, dict[str, Any]]:
    """Read the file of a study, and its base case.

    Returns
    -------
    Study
        What varies.
    dict
        The tables of the base case, its settings applied.

    Raises
    ------
    CaseError
        If a file cannot be read, or what it says is wrong; one line an error.
    """
    path = Path(path)
    tables = read_toml(path)
    if "bodies" in tables and "case" not in tables:
        raise CaseError(
            f"{path} is a case, not a study; a study names a case, as case = {path.name!r}, and "
            "says what varies in it, in [grid] say"
        )
    study = validate_study(tables)
    try:
        base = read_toml(path.parent / study.case)
    except CaseError as error:
        raise CaseError(str(error), "case") from None
    return study, apply_settings(base, study.settings)


def validate_study(data: Mapping[str, Any]) -> Study:
    """Turn tables into a study.

    Parameters
    ----------
    data : Mapping
        The tables of a study, as a TOML file has them. A path may be a quoted
        key, ``"load.normal"``, or tables in each other.

    Raises
    ------
    CaseError
        If anything in `data` is wrong; one line an error.
    """
    data = dict(data)
    for key in ("settings", "grid", "zip"):
        if key in data:
            data[key] = _by_path(data[key], key)
    if isinstance(data.get("list"), list):
        data["list"] = [_by_path(point, f"list[{i}]") for i, point in enumerate(data["list"])]
    sample = data.get("sample")
    if isinstance(sample, Mapping) and "ranges" in sample:
        ranges = _by_path(sample["ranges"], "sample.ranges")
        data["sample"] = {**sample, "ranges": ranges}
    try:
        study = Study.model_validate(data)
    except ValidationError as error:
        raise case_error(error) from None
    if not (study.grid or study.zip or study.list or study.sample):
        raise CaseError("nothing varies; give [grid], [zip], [[list]] or [sample]")
    return study


def _by_path(table: Any, where: str) -> Any:
    """Return values by path, of tables that may lie in each other as those of the case do."""
    found: dict[str, Any] = {}

    def collect(inside: Mapping[str, Any], prefix: str) -> None:
        for key, value in inside.items():
            path = f"{prefix}{key}"
            if isinstance(value, Mapping) and value and not (_RANGE & value.keys()):
                collect(value, f"{path}.")
            elif path in found:
                raise CaseError(f"{path!r} is given twice", where)
            else:
                found[path] = value

    if not isinstance(table, Mapping):
        return table
    collect(table, "")
    return found
