"""What came of the checks."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

Status = Literal["passed", "failed", "expected failure", "not applicable"]


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
        ``passed``, ``failed``, ``expected failure`` or ``not applicable``.
    message : str
        What was found and what is needed, why a failure was expected, or why
        the check does not apply.
    """

    check: str
    fact: str
    config: str
    status: Status
    message: str = ""


@dataclass(frozen=True)
class Report:
    """What came of all checks of one class; its text is a table.

    Parameters
    ----------
    subject : str
        The class and its name in a case.
    kind : str
        Its kind in words, as ``"wear law"``.
    outcomes : tuple of Outcome
        By configuration, then by check.
    """

    subject: str
    kind: str
    outcomes: tuple[Outcome, ...]

    @property
    def counts(self) -> Mapping[str, int]:
        """How many outcomes there are of each status."""
        return Counter(outcome.status for outcome in self.outcomes)

    @property
    def failures(self) -> tuple[Outcome, ...]:
        """The checks that failed, or passed where a failure was expected."""
        return tuple(outcome for outcome in self.outcomes if outcome.status == "failed")

    @property
    def ok(self) -> bool:
        """Whether something was checked and nothing failed."""
        return bool(self.counts["passed"]) and not self.failures

    def __str__(self) -> str:
        counted = ", ".join(f"{count} {status}" for status, count in self.counts.items())
        lines = [f"{self.kind} {self.subject}: {counted}"]
        width = max((len(outcome.check) for outcome in self.outcomes), default=0)
        spoiled = Counter(failure.message for failure in self.failures)
        told: set[str] = set()
        config = None
        for outcome in self.outcomes:
            if outcome.config != config:
                config = outcome.config
                lines.append(f"  with {config}")
            line = f"    {outcome.check:<{width}}  {outcome.status}"
            message = outcome.message
            if outcome.status == "failed":
                # What spoils many checks is told with the first of them.
                if message in told:
                    continue
                told.add(message)
                count = spoiled[message]
                message += f" (this spoils {count} checks)" if count > 1 else ""
            lines.append(f"{line}: {message}" if message else line)
        return "\n".join(lines)
