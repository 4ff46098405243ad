"""Write which checks find each mistake: python tests/testing/conformance/found.py, minutes."""

import json
import sys
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

REPOSITORY = Path(__file__).parents[3]
TABLE = REPOSITORY / "docs/_data/mistakes.json"


def main() -> None:
    """Check every model with a mistake, and write the table."""
    sys.path.insert(0, str(REPOSITORY / "tests"))
    warnings.simplefilter("ignore")
    from testing.conformance.mistakes import MISTAKES, configuration

    from tribo.testing.kit import names_of, suites

    asked = {words: next(suites(cls, [configuration(cls)])) for words, cls in MISTAKES.items()}
    found: dict[str, list[str]] = {words: [] for words in asked}
    ends: set[str] = set()
    # A whole run only where nothing else finds it.
    for runs in (False, True):
        calls = [
            (words, checks, name)
            for words, checks in asked.items()
            for name in sorted(names_of(type(checks)))
            if name.startswith("runs_") == runs and not (runs and found[words])
        ]
        for words, name, ended in failures(calls):
            print(f"{words}: {name}", flush=True)
            found[words].append(name)
            ends |= {words} if ended else set()
    rows = [
        {
            "mistake": words,
            "kind": type(checks._config).kind().replace("_", " "),
            "found_by": found[words],
            "ends_the_process": words in ends,
        }
        for words, checks in asked.items()
    ]
    lines = ",\n".join(json.dumps(row, ensure_ascii=False) for row in rows)
    TABLE.write_text(f"[\n{lines}\n]\n", encoding="utf-8")


def failures(calls: list[Any]) -> Iterator[tuple[str, str, bool]]:
    """Yield mistake and name of each check that fails, and whether it ended its process."""
    from tribo.registry.child import in_child
    from tribo.testing.kit import outcome_of

    while calls:
        outcomes, ended = in_child(outcome_of, [call[1:] for call in calls])
        for (words, _, name), outcome in zip(calls, outcomes, strict=False):
            if outcome.status == "failed":
                yield words, name, False
        calls = calls[len(outcomes) :]
        if ended:
            last, _, name = calls[0]
            yield last, name, True
            calls = [call for call in calls if call[0] != last]


if __name__ == "__main__":
    main()
