"""All validation cases: of the kernel, of the installed packages, and of a folder."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from tribo.core.errors import CaseError, warn
from tribo.registry.all_plugins import from_all_plugins
from tribo.registry.hookspecs import hookimpl
from tribo.registry.registry import default_registry
from tribo.verification.validation import ValidationCase

REFUSING = ("allow_", "expect_", "max_")
"""How keys begin that refuse a case or a result, and change none."""


@hookimpl(trylast=True)
def tribo_cases() -> tuple[Path, ...]:
    """Offer the cases of the kernel."""
    return (Path(__file__).with_name("cases"),)


def installed_cases() -> list[ValidationCase]:
    """Return the cases of the kernel and of the installed packages."""
    found: list[ValidationCase] = []
    for folder in from_all_plugins("tribo_cases", sys.modules[__name__]):
        try:
            found += cases_in(folder)
        except CaseError as error:
            warn(f"{error}; its cases are left out")
    return found


def cases_in(folder: Path) -> list[ValidationCase]:
    """Return the case that a folder is, or those in it; CaseError if there is none."""
    place = folder.resolve()
    files = [*place.glob("expected.toml"), *sorted(place.glob("*/expected.toml"))]
    if not files:
        raise CaseError(f"{folder} holds no expected.toml; write one as on the page 'Verification'")
    return [ValidationCase(path.parent) for path in files]


def called(name: str, cases: list[ValidationCase]) -> list[ValidationCase]:
    """Return the cases whose name begins so; CaseError if there is none."""
    chosen = [case for case in cases if case.name.startswith(name)]
    if not chosen:
        listed = ", ".join(dict.fromkeys(case.name.partition("_")[0] for case in cases))
        raise CaseError(
            f"{name}: there is no such file, folder or case; names of cases begin with {listed}"
        )
    return chosen


def uncovered(cases: Sequence[ValidationCase]) -> list[str]:
    """Return installed components that no case uses, and their keys that none sets."""
    registry = default_registry()
    registry.load_all()
    known = set(registry.components)
    for name in registry.components:
        keys = getattr(registry.find(name), "model_fields", {})
        known |= {f"{name}.{key}" for key in keys if not key.startswith(REFUSING)}
    return sorted(known.difference(*(case.uses for case in cases)))
