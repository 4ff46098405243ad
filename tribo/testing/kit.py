"""Run the checks of an interface on a class."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from types import MappingProxyType
from typing import Any, Literal

from pydantic import ValidationError

from tribo.component import Component
from tribo.core.errors import PluginError
from tribo.core.explain import case_error
from tribo.core.words import said
from tribo.registry.child import in_child
from tribo.registry.kinds import check_class
from tribo.registry.registry import place
from tribo.testing.checks import Checks
from tribo.testing.checks_contact_solver import ContactSolverChecks
from tribo.testing.checks_effect import EffectChecks
from tribo.testing.checks_kinematics import KinematicsChecks
from tribo.testing.checks_observer import ObserverChecks
from tribo.testing.checks_surface import SurfaceChecks
from tribo.testing.checks_wear_law import WearLawChecks
from tribo.testing.compare import CheckFailed, NotApplicable
from tribo.testing.likely import LIKELY
from tribo.testing.process import process_restored

SUITES: Mapping[str, type[Checks]] = MappingProxyType(
    {
        "contact_solver": ContactSolverChecks,
        "wear_law": WearLawChecks,
        "kinematics": KinematicsChecks,
        "surface": SurfaceChecks,
        "effect": EffectChecks,
        "observer": ObserverChecks,
    }
)
"""The checks of each kind of component."""

Config = Component | Mapping[str, Any]


@dataclass(frozen=True)
class Outcome:
    """What came of one check with one configuration.

    Parameters
    ----------
    check : str
        Name of the check.
    fact : str
        What the check tests, in one sentence.
    config : str
        The configuration, shortened.
    status : str
        ``passed``, ``failed`` or ``not applicable``.
    message : str
        What was found and what is needed, or why the check does not apply.

    Examples
    --------
    >>> from tribo.testing import check
    >>> outcome = check(tribo.Flat).outcomes[-1]
    >>> outcome.check, outcome.status
    ('curvature_is_that_of_the_heights', 'passed')
    """

    check: str
    fact: str
    config: str
    status: Literal["passed", "failed", "not applicable"]
    message: str = ""


@dataclass(frozen=True)
class Report:
    """What came of all checks of one class; its text is a table.

    Parameters
    ----------
    title : str
        The class, its kind and its name in a case.
    outcomes : tuple of Outcome
        By configuration, then by check.

    Examples
    --------
    >>> from tribo.testing import check
    >>> check(tribo.Sphere, [{"radius": "5 mm"}]).ok
    True
    """

    title: str
    outcomes: tuple[Outcome, ...]

    @property
    def failures(self) -> tuple[Outcome, ...]:
        """The checks that failed."""
        return tuple(outcome for outcome in self.outcomes if outcome.status == "failed")

    @property
    def ok(self) -> bool:
        """Whether nothing failed."""
        return not self.failures

    def __str__(self) -> str:
        counts = Counter(outcome.status for outcome in self.outcomes)
        lines = [f"{self.title}: {', '.join(f'{n} {status}' for status, n in counts.items())}"]
        width = max(len(outcome.check) for outcome in self.outcomes)
        spoiled = Counter(failure.message for failure in self.failures)
        for config, outcomes in groupby(self.outcomes, lambda outcome: outcome.config):
            lines.append(f"  with {config}")
            for outcome in outcomes:
                # A failure of many checks is reported with the first of them.
                count = spoiled.pop(outcome.message, 0) if outcome.status == "failed" else 1
                more = f" (this spoils {count} checks)" if count > 1 else ""
                message = f": {outcome.message}{more}" if outcome.message else ""
                if count:
                    lines.append(f"    {outcome.check:<{width}}  {outcome.status}{message}")
        return "\n".join(lines)


def check(cls: type[Component], configs: Sequence[Config] | None = None) -> Report:
    """Check that a class fulfils its interface, with each of some configurations.

    The bodies of the cases it is tried in are called ``ball`` and ``disk``. A `Field` that the
    class requires has values about the typical one, or follows the pressure by the required
    ``NAME_slope``; where only a name is required, it is about 1.

    Parameters
    ----------
    cls : type
        The class; which checks it gets follows from the interface it
        subclasses.
    configs : sequence of Component or Mapping, optional
        Valid configurations, as objects or as in a case; ``type`` may be left
        out. By default the `examples` of the class or, without any, its defaults.

    Returns
    -------
    Report
        Of every check with every configuration.

    Raises
    ------
    TypeError
        If `cls` does not implement one interface.
    ValueError
        If there is no configuration, or one is not valid.

    Examples
    --------
    >>> from tribo.testing import check
    >>> str(check(tribo.Flat)).splitlines()[0]
    'surface Flat (flat): 10 passed'
    """
    check_class(cls)
    asked = [(checks, name) for checks in suites(cls, configs) for name in names_of(type(checks))]
    # No component can end or hold up this process.
    outcomes, ended = in_child(outcome_of, asked)
    lost = f"it {ended}, as no call of a component may; nothing more is tried"
    outcomes += [_came(*each, "failed", lost) for each in asked[len(outcomes) :]]
    kind = cls.kind().replace("_", " ")
    return Report(f"{kind} {cls.__qualname__} ({cls.type})", tuple(outcomes))


def parametrize_checks(
    cls: type[Component], configs: Sequence[Config] | None = None
) -> Callable[..., None]:
    """Return a test function with which pytest runs each check with each configuration.

    A test file needs one line::

        test_conformance = parametrize_checks(Fretting, configs=[{"k": "1e-15 1/Pa"}])

    Parameters
    ----------
    cls, configs
        As in `check`.

    Returns
    -------
    callable
        A test, parametrized by check and configuration. A check that does not
        apply is skipped.

    Raises
    ------
    TypeError, ValueError
        As `check`.

    Examples
    --------
    >>> from tribo.testing import parametrize_checks
    >>> test_sphere = parametrize_checks(tribo.Sphere, [{"radius": "5 mm"}])
    """
    import pytest

    check_class(cls)
    tests = [
        pytest.param(checks, name, id=f"{name}-{number}")
        for number, checks in enumerate(suites(cls, configs))
        for name in names_of(type(checks))
    ]

    @pytest.mark.parametrize(("checks", "name"), tests)
    def test_conformance(checks: Checks, name: str) -> None:
        outcome = outcome_of(checks, name)
        if outcome.status == "not applicable":
            pytest.skip(outcome.message)
        if outcome.status == "failed":
            told = f"{outcome.fact} With {outcome.config}: {outcome.message}"
            pytest.fail(told, pytrace=False)

    return test_conformance


def suites(cls: type[Component], configs: Sequence[Config] | None) -> Iterator[Checks]:
    """Yield the checks of a class with each of its configurations."""
    configs = (cls.examples or [{}]) if configs is None else configs
    if not (isinstance(configs, Sequence) and configs):
        raise ValueError(f"nothing would be checked of {cls.__qualname__}: give a configuration")
    made = []
    for number, config in enumerate(configs):
        try:
            made.append(cls.model_validate(config))
        except ValidationError as error:
            raise ValueError(
                f"{cls.__qualname__} has no valid configuration at {number}: {case_error(error)}; "
                "a class gives valid ones as examples = ({…},)"
            ) from error
    yield from (SUITES[cls.kind()](config, made) for config in made)


def names_of(suite: type[Checks]) -> list[str]:
    """Return the names of the checks of a suite: its public methods."""
    methods = [name for base in reversed(suite.__mro__) for name in vars(base)]
    return [name for name in methods if not name.startswith("_")]


def outcome_of(checks: Checks, name: str) -> Outcome:
    """Make one check, by its name."""
    try:
        with process_restored():
            getattr(checks, name)()
    except NotApplicable as reason:
        return _came(checks, name, "not applicable", str(reason))
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        # What the class itself raised under a guard is reported as it was.
        cause = error.__cause__ if isinstance(error, PluginError) and error.__cause__ else error
        words = f"it raised {said(cause)}{place(cause, checks._cls.__module__)}"
        if isinstance(cause, CheckFailed | PluginError):
            likely = f" (often: {LIKELY[name]})" if name in LIKELY else ""
            words = " ".join(str(cause).split()) + likely
        return _came(checks, name, "failed", words)
    return _came(checks, name, "passed")


def _came(checks: Checks, name: str, status: Any, message: str = "") -> Outcome:
    """Return the outcome of a check, with the configuration as short text."""
    fact = str(getattr(checks, name).__doc__)
    return Outcome(name, fact, f"{checks._config!r:.60}", status, message)
