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

    from tribo.registry.child import in_child
    from tribo.testing.kit import names_of, outcome_of, suites

    rows = []
    for words, cls in MISTAKES.items():
        (checks,) = suites(cls, [configuration(cls)])
        names, runs = [], []
        for name in sorted(names_of(type(checks))):
            (runs if name.startswith("runs_") else names).append(name)
        # A whole run only where nothing else finds it.
        for some in (names, runs):
            outcomes, ended = in_child(outcome_of, [(checks, name) for name in some])
            found = [each.check for each in outcomes if each.status == "failed"]
            found += [some[len(outcomes)]] if ended else []
            if found:
                break
        kind, ends = cls.kind().replace("_", " "), bool(ended)
        rows.append({"mistake": words, "kind": kind, "found_by": found, "ends_the_process": ends})
        print(f"{words}: {', '.join(found) or 'not found'}", flush=True)
    lines = ",\n".join(json.dumps(row, ensure_ascii=False) for row in rows)
    TABLE.write_text(f"[\n{lines}\n]\n", encoding="utf-8")


if __name__ == "__main__":
    main()
