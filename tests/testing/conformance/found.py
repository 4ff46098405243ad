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
        found, ended = [], ""
        # A whole run only where nothing else finds it.
        for runs in (False, True):
            names = sorted(n for n in names_of(type(checks)) if n.startswith("runs_") == runs)
            if not found:
                outcomes, ended = in_child(outcome_of, [(checks, name) for name in names])
                found = [each.check for each in outcomes if each.status == "failed"]
                found += names[len(outcomes) :][:1]
        print(f"{words}: {', '.join(found)}", flush=True)
        kind = cls.kind().replace("_", " ")
        row = {"mistake": words, "kind": kind, "found_by": found, "ends_the_process": bool(ended)}
        rows.append(json.dumps(row, ensure_ascii=False))
    TABLE.write_text("[\n{}\n]\n".format(",\n".join(rows)), encoding="utf-8")


if __name__ == "__main__":
    main()
