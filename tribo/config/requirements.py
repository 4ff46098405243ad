"""Are the distributions that a case asks for installed?"""

from __future__ import annotations

from collections.abc import Iterable
from importlib import metadata

from packaging.requirements import Requirement

from tribo.core.errors import CaseError


def check_requirements(requires: Iterable[str]) -> None:
    """Raise `CaseError` unless every requirement, as ``"acme-tribo>=1.2"``, is met.

    One whose marker, as ``; python_version < "3.12"``, does not hold here is none.
    """
    for text in requires:
        requirement = Requirement(text)
        if requirement.marker is not None and not requirement.marker.evaluate({"extra": ""}):
            continue
        try:
            version = metadata.version(requirement.name)
        except metadata.PackageNotFoundError:
            found = "is not installed"
        else:
            if requirement.specifier.contains(version, prereleases=True):
                continue
            found = f"is installed in version {version}"
        raise CaseError(
            f"{text!r} is needed, but {requirement.name} {found}; install it with pip", "requires"
        )
