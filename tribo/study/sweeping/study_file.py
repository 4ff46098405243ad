"""The file of a study: a base case, what varies in it, and the resulting points."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from itertools import product
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, ValidationError

from tribo.config.load import case_tables, read_toml
from tribo.config.overrides import apply_settings, leaves_at
from tribo.core.errors import CaseError
from tribo.core.explain import case_error
from tribo.core.table import Table
from tribo.core.toml import inline
from tribo.study.variation import Point, check_distinct, valid_case

Values = Annotated[tuple[Any, ...], Field(min_length=1)]
_VARIED = {"load.normal": ["50 N", "100 N"]}
_RANGE = frozenset({"low", "high"})


class Range(Table):
    """A range of a quantity."""

    low: Any
    """Lower end, as the case would have it: a number, or text with a unit."""
    high: Any
    """Upper end."""
    scale: Literal["linear", "log"] = "linear"
    """Whether values or their logarithms are spread evenly."""


class Sample(Table):
    """Points that fill a box of ranges."""

    method: Literal["latin_hypercube", "sobol"]
    """Distribution of the points."""
    count: Annotated[int, Field(ge=1)]
    """Number of points; `sobol` spreads a power of two evenly."""
    seed: Annotated[int, Field(ge=0)] = 0
    """Another seed gives other points, the same one always the same."""
    ranges: dict[str, Range] = Field(min_length=1)
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
    sample: Sample | None = None
    """Points in a box of ranges."""


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
    sample = data.get("sample")
    if isinstance(sample, dict) and "ranges" in sample:
        sample["ranges"] = by_path(sample["ranges"], "sample.ranges")
    try:
        study = Study.model_validate(data)
    except ValidationError as error:
        raise case_error(error) from None
    if not (study.grid or study.zip or study.list or study.sample):
        raise CaseError(f"nothing varies; give grid, zip, list or sample, as {example}")
    return study


def points(study: Study, data: Mapping[str, Any], most: float = math.inf) -> list[Point]:
    """Return the settings of every run; what is listed last varies first.

    Sampled quantities are read as the base case `data` has them. CaseError if there are more than
    `most`, or the study contradicts itself.
    """
    sample = study.sample
    listed = dict.fromkeys(path for point in study.list for path in point)
    check_distinct([*listed, *study.zip, *study.grid, *(sample.ranges if sample else ())])
    lengths = {path: len(values) for path, values in study.zip.items()}
    if len(set(lengths.values())) > 1:
        given = ", ".join(f"{path} has {length}" for path, length in lengths.items())
        raise CaseError(f"values that go together must be equally many: {given}", "zip")
    zipped = [
        dict(zip(study.zip, row, strict=True)) for row in zip(*study.zip.values(), strict=True)
    ]
    axes = [[{path: value} for value in values] for path, values in study.grid.items()]
    blocks = [block for block in (list(study.list), zipped, *axes) if block]
    count = math.prod(map(len, blocks)) * (sample.count if sample else 1)
    if count > most:
        raise CaseError(f"the study asks for {count} runs; if that is meant, give --yes")
    if sample:
        blocks.append(_sampled(sample, data, _merged(block[0] for block in blocks)))
    return [_merged(parts) for parts in product(*blocks)]


def by_path(table: Any, where: str, prefix: str = "") -> Any:
    """Return values by path; a path may be a quoted key, or tables in each other."""
    if not isinstance(table, Mapping):
        return table
    found: dict[str, Any] = {}
    for key, value in table.items():
        path = f"{prefix}{key}"
        nested = isinstance(value, Mapping) and value and not (_RANGE & value.keys())
        for name, item in (by_path(value, where, f"{path}.") if nested else {path: value}).items():
            if name in found:
                raise CaseError(f"{name!r} is given twice", where)
            found[name] = item
    return found


def _merged(parts: Iterable[Point]) -> Point:
    return {path: value for part in parts for path, value in part.items()}


def _sampled(sample: Sample, data: Mapping[str, Any], first: Point) -> list[Point]:
    """Return points in the box of ranges; `first` are the other values of the first run."""
    low, high = (_ends(sample, end, data, first) for end in ("low", "high"))
    for path, given in sample.ranges.items():
        place = f"sample.ranges.{path}"
        if low[path] >= high[path]:
            raise CaseError(
                f"low, {given.low}, must be less than high, {given.high}; exchange them", place
            )
        if given.scale == "log" and low[path] <= 0:
            raise CaseError(
                f"low must be greater than 0 on a log scale; {given.low} is given", place
            )
    return [
        {
            path: low[path] * math.exp(part * math.log(high[path] / low[path]))
            if given.scale == "log"
            else low[path] + part * (high[path] - low[path])
            for (path, given), part in zip(sample.ranges.items(), map(float, row), strict=True)
        }
        for row in _spread(sample)
    ]


def _spread(sample: Sample) -> Any:
    """Return points in the unit cube."""
    from scipy.stats import qmc

    if sample.method == "latin_hypercube":
        return qmc.LatinHypercube(len(sample.ranges), seed=sample.seed).random(sample.count)
    # A longer sequence begins with the points of a shorter one, of which SciPy would warn.
    above = 1 << (sample.count - 1).bit_length()
    return qmc.Sobol(len(sample.ranges), seed=sample.seed).random(above)[: sample.count]


def _ends(sample: Sample, end: str, data: Mapping[str, Any], first: Point) -> dict[str, float]:
    """Return one end of each range in SI, as the case reads it."""
    given = {path: getattr(each, end) for path, each in sample.ranges.items()}
    try:
        case = valid_case(data, {**first, **given})
    except CaseError as error:
        raise CaseError(f"the {end} ends cannot be used: {error}", "sample.ranges") from None
    found = {}
    for path in given:
        values = [value for _, value, _ in leaves_at(case, path)]
        if [type(value) for value in values] != [float]:
            raise CaseError("is not a quantity to be sampled; list its values in [grid]", path)
        found[path] = values[0]
    return found
