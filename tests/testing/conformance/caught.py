"""Wrong implementations, each with the check that must catch it."""

from typing import Any

from tribo.testing.subject import CheckFailed

MUTANTS: list[tuple[str, type[Any], type[Exception]]] = []


def caught_by(check: str, raising: type[Exception] = CheckFailed):
    """List a class as wrong, with what its check raises."""

    def add(mutant):
        MUTANTS.append((check, mutant, raising))
        return mutant

    return add
