"""The points of a study: which values each run has."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping, Sequence
from itertools import product
from typing import Any

from tribo.config.overrides import path_keys
from tribo.core.errors import CaseError, TriboWarning
from tribo.study.sweeping.study_file import RangeConfig, SampleConfig, Study
from tribo.study.variation import Axis, grid, valid_case

Point = dict[str, Any]


def count(study: Study) -> int:
    """Return the number of runs."""
    lengths = [len(values) for values in study.grid.values()]
    lengths += [len(values) for values in list(study.zip.values())[:1]]
    lengths += [len(study.list)] if study.list else []
    lengths += [study.sample.count] if study.sample else []
    return math.prod(lengths)


def points(study: Study, data: Mapping[str, Any]) -> list[Point]:
    """Return the settings of every run; what is listed last varies first.

    Parameters
    ----------
    study : Study
        What varies.
    data : Mapping
        The tables of the base case; it says what the quantities are whose
        ranges are sampled.

    Raises
    ------
    CaseError
        If a path is none or varies twice, values that go together are not
        equally many, or a range is none.
    """
    blocks = {
        "list": [dict(point) for point in study.list] or [{}],
        "zip": _zipped(study.zip),
        "grid": grid([Axis(path, values) for path, values in study.grid.items()]),
    }
    sampled = dict.fromkeys(study.sample.ranges) if study.sample else {}
    _check_distinct({**blocks, "sample": [sampled]})
    if study.sample:
        blocks["sample"] = _sampled(study.sample, data, _merged(b[0] for b in blocks.values()))
    return [_merged(parts) for parts in product(*blocks.values())]


def _merged(parts: Any) -> Point:
    return {path: value for part in parts for path, value in part.items()}


def _zipped(axes: Mapping[str, Sequence[Any]]) -> list[Point]:
    lengths = {path: len(values) for path, values in axes.items()}
    if len(set(lengths.values())) > 1:
        given = ", ".join(f"{path} has {length}" for path, length in lengths.items())
        raise CaseError(f"values that go together must be equally many: {given}", "zip")
    return [
        dict(zip(axes, values, strict=True)) for values in zip(*axes.values(), strict=True)
    ] or [{}]


def _check_distinct(blocks: Mapping[str, Sequence[Point]]) -> None:
    seen: dict[tuple[str, ...], str] = {}
    for name, block in blocks.items():
        for path in {path: None for point in block for path in point}:
            keys = tuple(path_keys(path))
            other = seen.setdefault(keys, name)
            if other != name:
                raise CaseError(f"varies in {other} and in {name}; leave it out of one", path)


def _sampled(sample: SampleConfig, data: Mapping[str, Any], first: Point) -> list[Point]:
    """Return points in the box of ranges; `first` are the other values of the first run."""
    paths = list(sample.ranges)
    low = _end(sample.ranges, "low", data, first)
    high = _end(sample.ranges, "high", data, first)
    for path in paths:
        _check_range(path, sample.ranges[path], low[path], high[path])
    unit = _spread(sample, len(paths))
    return [
        {
            path: _between(sample.ranges[path].scale, low[path], high[path], float(u))
            for path, u in zip(paths, row, strict=True)
        }
        for row in unit
    ]


def _spread(sample: SampleConfig, dimensions: int) -> Any:
    """Return points in the unit cube."""
    from scipy.stats import qmc

    if sample.method == "latin_hypercube":
        return qmc.LatinHypercube(dimensions, seed=sample.seed).random(sample.count)
    above = 1 << (sample.count - 1).bit_length()
    if above != sample.count:
        warnings.warn(
            "sample.count: Sobol points are spread evenly where they are a power of two, as "
            f"{above // 2} or {above}; {sample.count} are asked for",
            TriboWarning,
            stacklevel=2,
        )
    # Of the points up to a power of two, the first ones are the same for any count.
    return qmc.Sobol(dimensions, seed=sample.seed).random(above)[: sample.count]


def _end(
    ranges: Mapping[str, RangeConfig], end: str, data: Mapping[str, Any], first: Point
) -> dict[str, float]:
    """Return one end of each range in SI, as the case reads it."""
    ends = {path: getattr(given, end) for path, given in ranges.items()}
    try:
        case = valid_case(data, {**first, **ends})
    except CaseError as error:
        raise CaseError(f"the {end} ends cannot be used: {error}", "sample.ranges") from None
    read = case.model_dump(mode="json")
    return {path: _number(read, path) for path in ends}


def _number(case: Any, path: str) -> float:
    for key in path_keys(path):
        case = case[int(key)] if isinstance(case, list) else case[key]
    if not isinstance(case, float):
        raise CaseError("is no quantity that could be sampled; list its values in [grid]", path)
    return case


def _check_range(path: str, given: RangeConfig, low: float, high: float) -> None:
    if low >= high:
        raise CaseError(
            f"low must be less than high; {given.low} and {given.high} are given",
            f"sample.ranges.{path}",
        )
    if given.scale == "log" and low <= 0:
        raise CaseError(
            f"low must be greater than 0 on a log scale; {given.low} is given",
            f"sample.ranges.{path}",
        )


def _between(scale: str, low: float, high: float, part: float) -> float:
    if scale == "log":
        return low * math.exp(part * math.log(high / low))
    return low + part * (high - low)
