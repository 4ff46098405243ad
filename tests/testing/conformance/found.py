"""Write which checks find each mistake: python tests/testing/conformance/found.py, minutes."""

import json
import sys
import warnings
from pathlib import Path

REPOSITORY = Path(__file__).parents[3]
TABLE = REPOSITORY / "docs/_data/mistakes.json"


def main() -> None:
    """Check every model with a mistake, and write the table."""
    sys.path.insert(0, str(REPOSITORY / "tests"))
    warnings.simplefilter("ignore")
    from testing.conformance.mistakes import MISTAKES, configuration

    from tribo.testing.kit import names_of, outcome_of, suites

    rows = []
    for words, cls in MISTAKES.items():
        (checks,) = suites(cls, [configuration(cls)], {})
        # A whole run only where nothing else finds it.
        found: list[str] = []
        for name in sorted(names_of(type(checks)), key=lambda name: name.startswith("runs_")):
            if found and name.startswith("runs_"):
                break
            if outcome_of(checks, name).status == "failed":
                found.append(name)
            if checks._lost:
                break
        ends = bool(checks._lost)
        kind = cls.kind().replace("_", " ")
        rows.append({"mistake": words, "kind": kind, "found_by": found, "ends_the_process": ends})
        print(f"{words}: {', '.join(found) or 'not found'}", flush=True)
    lines = ",\n".join(json.dumps(row, ensure_ascii=False) for row in rows)
    TABLE.write_text(f"[\n{lines}\n]\n", encoding="utf-8")


if __name__ == "__main__":
    main()
