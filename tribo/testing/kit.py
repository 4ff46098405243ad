"""Run the checks of an interface on a class."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

from pydantic import ValidationError

from tribo.component import Component
from tribo.core.words import said
from tribo.registry.kinds import Kind, kind_of
from tribo.testing import (
    checks_contact_solver,
    checks_effect,
    checks_kinematics,
    checks_observer,
    checks_surface,
    checks_wear_law,
    samples,
)
from tribo.testing.checks_component import COMPONENT_CHECKS
from tribo.testing.checks_config import CONFIG_CHECKS
from tribo.testing.report import Outcome, Report
from tribo.testing.subject import Check, CheckFailed, FieldValue, Revival, Subject

ENOUGH = "enough_checks_apply"
_NOTHING: Mapping[str, Any] = MappingProxyType({})


@dataclass(frozen=True)
class Suite:
    """The checks of a kind, and how many of them each configuration must pass."""

    checks: tuple[Check, ...]
    minimum: int


def _suite(checks: tuple[Check, ...], minimum: int) -> Suite:
    return Suite((*CONFIG_CHECKS, *COMPONENT_CHECKS, *checks), minimum)


# The minimum is what applies to the plainest implementation, less two.
SUITES: Mapping[str, Suite] = MappingProxyType(
    {
        "contact_solver": _suite(checks_contact_solver.CHECKS, 24),
        "wear_law": _suite(checks_wear_law.CHECKS, 21),
        "kinematics": _suite(checks_kinematics.CHECKS, 26),
        "surface": _suite(checks_surface.CHECKS, 17),
        "effect": _suite(checks_effect.CHECKS, 19),
        "observer": _suite(checks_observer.CHECKS, 17),
    }
)

Config = Component | Mapping[str, Any]


def check(
    cls: type[Component],
    configs: Sequence[Config],
    *,
    expected_failures: Mapping[str, str] = _NOTHING,
    fields: Mapping[str, FieldValue] = _NOTHING,
) -> Report:
    """Check that a class fulfils its interface, with each of some configurations.

    The bodies of the cases it is tried in are called ``ball`` and ``disk``.

    Parameters
    ----------
    cls : type
        The class; which checks it gets follows from the interface it
        subclasses.
    configs : sequence of Component or Mapping
        Valid configurations, as objects or as in a case; ``type`` may be left
        out.
    expected_failures : Mapping[str, str], optional
        Why a check, by name, cannot be passed. One that passes all the same
        counts as a failure.
    fields : Mapping[str, float or callable], optional
        Typical values, in SI, of the local fields that the class requires. One
        that follows the pressure is given as a function of it, and belongs to
        what the law's derivative is compared with. Unless given, a field whose
        ``NAME_slope`` is required too is that slope times the pressure; others
        have plausible values, most of them the same at every pressure.

    Returns
    -------
    Report
        Of every check with every configuration.

    Raises
    ------
    TypeError
        If `cls` does not implement one interface.
    ValueError
        If a configuration is not valid, or `expected_failures` names no check.
    """
    kind = kind_of(cls)
    _expect_known(kind, expected_failures)
    outcomes: list[Outcome] = []
    for subject in subjects(cls, configs, fields):
        outcomes += [_outcome(one, subject, expected_failures) for one in SUITES[kind.name].checks]
        outcomes.append(_outcome(_enough(expected_failures), subject, _NOTHING))
    if not outcomes:
        needed = (
            "not valid without configuration, and no example is given; put some in: "
            "model_config = ConfigDict(json_schema_extra={'examples': [{…}]})"
        )
        outcomes.append(Outcome(ENOUGH, "", "no configuration", "failed", needed))
    name = f"{cls.__qualname__} ({cls.type})"
    return Report(name, kind.words, tuple(outcomes))


def parametrize_checks(
    cls: type[Component],
    configs: Sequence[Config],
    *,
    expected_failures: Mapping[str, str] = _NOTHING,
    fields: Mapping[str, FieldValue] = _NOTHING,
) -> Callable[..., None]:
    """Return a test function with which pytest runs each check with each configuration.

    A test file needs one line::

        test_conformance = parametrize_checks(Fretting, configs=[{"k": "1e-15 1/Pa"}])

    Parameters
    ----------
    cls, configs, expected_failures, fields
        As in `check`.

    Returns
    -------
    callable
        A test, parametrized by check and configuration. A check that does not
        apply is skipped, an expected failure is an xfail.

    Raises
    ------
    TypeError, ValueError
        As `check`; also if `configs` is empty.
    """
    import pytest

    kind = kind_of(cls)
    _expect_known(kind, expected_failures)
    given = subjects(cls, configs, fields)
    if not given:
        raise ValueError(f"configs is empty: nothing would be checked of {cls.__qualname__}")
    tests = [
        pytest.param(one, subject, id=f"{one.name}-{subject.index}")
        for subject in given
        for one in (*SUITES[kind.name].checks, _enough(expected_failures))
    ]

    @pytest.mark.parametrize(("one", "subject"), tests)
    def test_conformance(one: Check, subject: Subject) -> None:
        __tracebackhide__ = True
        outcome = _outcome(one, subject, expected_failures)
        if outcome.status == "failed":
            pytest.fail(f"{one.fact} With {subject.label}: {outcome.message}", pytrace=False)
        if outcome.status == "expected failure":
            pytest.xfail(outcome.message)
        if outcome.status == "not applicable":
            pytest.skip(outcome.message)

    return test_conformance


def example_configs(cls: type[Component]) -> list[dict[str, Any]]:
    """Return configurations to check a class with, read off its schema.

    Parameters
    ----------
    cls : type
        The class.

    Returns
    -------
    list of dict
        The ``examples`` in the JSON schema (``json_schema_extra`` of the
        model's configuration); else ``{}`` alone if the defaults are valid;
        else nothing.

    Raises
    ------
    ValueError
        If the schema cannot be made, or its examples are no list of tables.
    """
    try:
        examples = cls.model_json_schema().get("examples")
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        raise ValueError(f"making the schema of {cls.__qualname__} raised {said(error)}") from error
    if examples:
        if not (isinstance(examples, list) and all(isinstance(e, Mapping) for e in examples)):
            raise ValueError(f"they are {examples!r}; they must be a list of tables")
        return [dict(example) for example in examples]
    try:
        cls.model_validate({})
    except ValidationError:
        return []
    return [{}]


def subjects(
    cls: type[Component], configs: Sequence[Config], fields: Mapping[str, FieldValue]
) -> list[Subject]:
    """Return the class with each of its configurations."""
    valid = list(_validated(cls, configs))
    revival = Revival(valid)
    kind = kind_of(cls).name
    fields = samples.following(getattr(cls, "requires", ()), fields)
    return [Subject(cls, kind, config, fields, revival, i) for i, config in enumerate(valid)]


def _validated(cls: type[Component], configs: Sequence[Config]) -> Iterator[Component]:
    for number, config in enumerate(configs):
        if isinstance(config, cls):
            yield config
            continue
        try:
            yield cls.model_validate(config)
        except ValidationError as error:
            what = f"configs[{number}] is not valid for {cls.__qualname__}"
            raise ValueError(f"{what}: {error}") from error


def _expect_known(kind: Kind, expected_failures: Mapping[str, str]) -> None:
    known = {one.name for one in SUITES[kind.name].checks}
    for name, reason in expected_failures.items():
        if name not in known:
            raise ValueError(f"expected_failures: no check of a {kind.words} is called {name!r}")
        if not reason.strip():
            raise ValueError(f"expected_failures: say why {name!r} cannot be passed")


def _outcome(one: Check, subject: Subject, expected: Mapping[str, str]) -> Outcome:
    def came(status: Any, message: str = "") -> Outcome:
        return Outcome(one.name, one.fact, subject.label, status, message)

    reason = expected.get(one.name)
    try:
        inapplicable = one.unless(subject)
        if inapplicable is not None:
            return came("not applicable", inapplicable)
        one.run(subject)
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        found = _found(error, subject.cls)
        return came("failed", found) if reason is None else came("expected failure", reason)
    if reason is not None:
        return came("failed", f"it passed, although a failure is expected ({reason})")
    return came("passed")


def _found(error: BaseException, cls: type[Component]) -> str:
    text = " ".join(str(error).split())
    if isinstance(error, CheckFailed):
        return text
    frames = traceback.extract_tb(error.__traceback__)
    own = [frame for frame in frames if Path(frame.filename).is_relative_to(_code(cls))]
    where = (own or frames)[-1]
    raised = f"it raised {type(error).__name__} in {where.filename}:{where.lineno}"
    return f"{raised}: {text}".rstrip(": ")


def _code(cls: type) -> Path:
    """Return the folder of the package that a class is in, or the file of its lone module."""
    module = sys.modules.get(cls.__module__.split(".")[0])
    folders = list(getattr(module, "__path__", ()))
    return Path(folders[0] if folders else getattr(module, "__file__", None) or "")


def _enough(expected: Mapping[str, str]) -> Check:
    def run(subject: Subject) -> None:
        suite = SUITES[subject.kind]
        applies = [
            one.name
            for one in suite.checks
            if one.name not in expected and one.unless(subject) is None
        ]
        if len(applies) < suite.minimum:
            raise CheckFailed(
                f"only {len(applies)} of {len(suite.checks)} checks apply; at least "
                f"{suite.minimum} must, for so little says nothing about the class"
            )

    return Check(ENOUGH, "Enough checks apply to say something.", run)
