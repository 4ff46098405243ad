"""The figures that earn trust, from one command: damage, fill, fuzz and verify.

    python tests/trials.py                      # about an hour; docs/_data/trust.json
    python tests/trials.py --cases 200 --damages 50 --disks 3 --json small.json

Every trial can be repeated with the seed that it prints. The exit code is 1 if one fails.
"""

import argparse
import dataclasses
import json
import os
import platform
import subprocess
import sys
import warnings
from importlib import metadata
from pathlib import Path

from fuzz.fuzzing import fuzz
from rich.console import Console
from rich.table import Table
from trust.damages import damage_and_read
from trust.full_disks import fill_and_resume

FIGURES = Path(__file__).parents[1] / "docs" / "_data" / "trust.json"
PACKAGES = ("tribo", "numpy", "scipy", "h5py", "pydantic")


def verified():
    """Count how the checks of ``tribo verify`` end."""
    command = [sys.executable, "-m", "tribo", "verify", "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    rows = json.loads(done.stdout)["rows"]
    verdicts = [row["verdict"] for row in rows]
    found = {verdict: verdicts.count(verdict) for verdict in ("holds", "fails", "not installed")}
    return found, done.returncode == 0


def trial(name, made):
    """Return a trial as a row."""
    figures = made.figures() if hasattr(made, "figures") else dataclasses.asdict(made)
    return {"trial": name, "good": made.good, "figures": figures}


def show(row):
    """Return the figures of a trial on a line."""
    return ", ".join(f"{name} {value}" for name, value in row["figures"].items())


def trials(given):
    """Make the trials one after another, and yield each as it ends."""
    yield trial("results damaged and read", damage_and_read(given.damages, given.seed))
    yield trial("disks filled, runs resumed", fill_and_resume(given.disks, given.seed))
    yield trial("cases and files made at random", fuzz(given.cases, given.seed))
    figures, good = verified()
    yield {"trial": "known answers computed (tribo verify)", "good": good, "figures": figures}


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--damages", type=int, default=1000)
    parser.add_argument("--disks", type=int, default=30)
    parser.add_argument("--cases", type=int, default=10000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--json", type=Path, default=FIGURES, help="docs/_data/trust.json")
    given = parser.parse_args()
    # Those of tribo are about coarse grids, which trials have.
    warnings.simplefilter("ignore")
    console, table, rows = Console(), Table("trial", "holds", "figures"), []
    for row in trials(given):
        console.print(f"{row['trial']}: {show(row)}", soft_wrap=True)
        table.add_row(row["trial"], "yes" if row["good"] else "NO", show(row))
        rows.append(row)
    console.print(table)
    found = {
        "python": platform.python_version(),
        "packages": {name: metadata.version(name) for name in PACKAGES},
        "system": platform.system(),
        "cores": os.cpu_count(),
        "seed": given.seed,
        "trials": rows,
    }
    given.json.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    sys.exit(not all(row["good"] for row in rows))


if __name__ == "__main__":
    main()
