"""Variants of a case: which values take turns, and the cases that follow."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

from tribo.case import Case
from tribo.config.load import validate_case
from tribo.config.overrides import apply_settings, parse_value, path_keys
from tribo.core.depth import check_depth
from tribo.core.errors import CaseError
from tribo.core.words import did_you_mean, suggestion
from tribo.registry.registry import Registry
from tribo.result.read import SAME_TIME
from tribo.simulation.run import Simulation

_NAMED = 3


@dataclass(frozen=True)
class Axis:
    """A value of a case that varies.

    Parameters
    ----------
    path : str
        Where it stands in the case, as ``"bodies.ball.wear.k"``.
    values : tuple
        What takes turns there, as TOML would give it; texts may be quantities.

    Raises
    ------
    CaseError
        If `path` is no path, or there are no values.
    """

    path: str
    values: tuple[Any, ...]

    def __post_init__(self) -> None:
        path_keys(self.path)
        if not self.values or "" in self.values:
            raise CaseError(
                f"{'no value is' if not self.values else 'an empty value is'} given; write the "
                f"values with commas between them, as in {self.path}=1,2",
                self.path,
            )

    @classmethod
    def parse(cls, text: str) -> Axis:
        """Read ``"path=a,b"``, or ``"path=[a, b]"`` with a TOML list of the values.

        Without brackets each value is read as TOML, or else as text.

        Raises
        ------
        CaseError
            If `text` is not of that form.
        """
        path, equals, values = text.partition("=")
        if not equals:
            raise CaseError(
                f"{text!r} is not of the form path=values, as in contact.type=winkler,dcfft"
            )
        return cls(path.strip(), _values(path.strip(), values.strip()))


@dataclass(frozen=True)
class Variant:
    """One of several cases that differ in some values.

    Parameters
    ----------
    label : str
        Short name, different from that of the other variants.
    settings : Mapping
        The values that differ, by path.
    case : Case
        The validated case.
    """

    label: str
    settings: Mapping[str, Any]
    case: Case


def grid(axes: Sequence[Axis]) -> list[dict[str, Any]]:
    """Return the settings of every combination of the axes' values; the last varies first.

    Raises
    ------
    CaseError
        If two axes are the same.
    """
    seen: dict[tuple[str, ...], str] = {}
    for axis in axes:
        keys = tuple(path_keys(axis.path))
        if keys in seen:
            raise CaseError("varies twice; give all its values together", axis.path)
        seen[keys] = axis.path
    paths = [axis.path for axis in axes]
    return [dict(zip(paths, values, strict=True)) for values in product(*(a.values for a in axes))]


def variants(
    data: Mapping[str, Any],
    settings: Iterable[Mapping[str, Any]],
    *,
    registry: Registry | None = None,
) -> list[Variant]:
    """Return the cases that follow from `data` with each of the settings.

    All are validated and composed, so that none fails over its input once
    others have run.

    Parameters
    ----------
    data : Mapping
        The tables of a case, as a TOML file has them.
    settings : iterable of Mapping
        Values by path, a mapping a variant; see `grid`. Setting ``X.type``
        to another type replaces the table X by that type's defaults.
    registry : Registry, optional
        Where to look components up; the installed plugins if left out.

    Raises
    ------
    CaseError
        If a variant is not valid, or two are the same case; the message says
        which and why.
    """
    points = list(settings)
    labels = [_label(point) for point in points]
    found: list[Variant] = []
    reasons: dict[str, list[str]] = {}
    for label, point in zip(labels, points, strict=True):
        try:
            found.append(Variant(label, point, valid_case(data, point, registry)))
        except CaseError as error:
            reasons.setdefault(str(error), []).append(label)
    if reasons:
        raise CaseError(_refusal(reasons, len(points)))
    same: dict[str, str] = {}
    for variant in found:
        other = same.setdefault(repr(variant.case), variant.label)
        if other is not variant.label:
            raise CaseError(f"{other} and {variant.label} are the same case; leave one of them out")
    return found


def check_saved(variant: Variant, times: Sequence[float], registry: Registry | None) -> None:
    """Check that a variant saves at times, in s; where a depth may end it, nobody knows before.

    Raises
    ------
    CaseError
        If it does not; the message says when it saves.
    """
    if not times or variant.case.stop.depth is not None:
        return
    model = Simulation(variant.case, registry).model
    saved = sorted({0.0, *model.case.output.save_times, model.end_time})
    for time in times:
        if not any(abs(time - each) <= SAME_TIME * model.end_time for each in saved):
            raise CaseError(
                f"{variant.label}: nothing is saved at {time:g} s, only at "
                f"{', '.join(f'{each:g}' for each in saved)} s; add it to output.save_times"
            )


def short_labels(varied: Sequence[Mapping[str, Any]]) -> list[str]:
    """Return the values alone, equal ones once, where all settings are of the same paths.

    Else whole labels.
    """
    whole = [_label(settings) for settings in varied]
    if len({tuple(settings) for settings in varied}) > 1:
        return whole
    short = [
        ", ".join(dict.fromkeys(_shown(value) for value in settings.values()))
        for settings in varied
    ]
    return short if len(set(short)) == len(short) else whole


def _values(path: str, text: str) -> tuple[Any, ...]:
    bracketed = text.startswith("[")
    try:
        read = tomllib.loads(f"values = {text if bracketed else f'[{text}]'}")
    except (ValueError, RecursionError) as error:
        if bracketed:
            raise CaseError(f"{text!r} is no list in TOML: {error}", path) from None
        return tuple(parse_value(part.strip()) for part in text.split(","))
    check_depth(read, path)
    values = tuple(read["values"])
    if not bracketed and len(values) == 1 and isinstance(values[0], str) and "," in values[0]:
        raise CaseError(
            f"its quotes make one value of {text}; leave them out, or give each value its own", path
        )
    return values


def valid_case(
    data: Mapping[str, Any], point: Mapping[str, Any], registry: Registry | None = None
) -> Case:
    """Return the validated case that follows from `data` with the settings of one point.

    Raises
    ------
    CaseError
        If it is not valid.
    """
    for path in point:
        _check_body(data, path)
    case = validate_case(apply_settings(data, point), registry=registry)
    Simulation(case, registry)
    return case


def _check_body(data: Mapping[str, Any], path: str) -> None:
    """A misspelt body would be read as a third one."""
    bodies = data.get("bodies")
    match path_keys(path):
        case ["bodies", name, *_] if isinstance(bodies, Mapping) and name not in bodies:
            raise CaseError(
                f"there is no body {name!r}{suggestion(did_you_mean(name, bodies))} "
                f"The bodies are {', '.join(bodies)}",
                path,
            )


def _refusal(reasons: Mapping[str, Sequence[str]], count: int) -> str:
    failing = sum(map(len, reasons.values()))
    which = "the only variant" if count == 1 else f"{failing} of {count} variants"
    lines = [f"{which} cannot be run; nothing was started:"]
    for reason, labels in reasons.items():
        named = "; ".join(labels[:_NAMED])
        more = f"; and {len(labels) - _NAMED} more" if len(labels) > _NAMED else ""
        first, *others = reason.splitlines()
        lines += [f"  with {named}{more}: {first}", *(f"    {line}" for line in others)]
    return "\n".join(lines)


def _label(settings: Mapping[str, Any]) -> str:
    return ", ".join(f"{path}={_shown(value)}" for path, value in settings.items())


def _shown(value: Any) -> str:
    """Return a value as short text: of a table its type, and its other keys."""
    if isinstance(value, Mapping):
        parts = [
            _shown(item) if key == "type" else f"{key}={_shown(item)}"
            for key, item in value.items()
        ]
        return " ".join(parts)
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_shown, value))}]"
    return str(value).lower() if isinstance(value, bool) else str(value)
