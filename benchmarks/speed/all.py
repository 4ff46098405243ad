"""Run the benchmarks that the page on speed shows, one after another, into one file.

Benchmarks that are not named stay as they are in the file, unless there is no such
benchmark any more. On a quiet machine; it takes about an hour and a quarter.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from benchmarks.lib.common import write

ROOT = Path(__file__).parents[2]
FIGURES = ROOT / "docs" / "_data" / "speed.json"
OPTIONS = {
    "contact_solve": ["--repeats", "1"],
    "hour": [],
    "resolved_loop": [],
    "fft_limit": [],
}


def main() -> None:
    """Run what was named, or all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(OPTIONS))
    parser.add_argument(
        "--json", type=Path, default=FIGURES, help="docs/_data/speed.json if left out"
    )
    chosen = parser.parse_args()
    unknown = set(chosen.names) - set(OPTIONS)
    if unknown:
        parser.error(f"no benchmark {', '.join(sorted(unknown))}; there are {', '.join(OPTIONS)}")
    before = json.loads(chosen.json.read_text(encoding="utf-8")) if chosen.json.exists() else {}
    found = {name: before[name] for name in OPTIONS if name in before}
    for name in chosen.names or OPTIONS:
        with TemporaryDirectory() as folder:
            figures = Path(folder) / "figures.json"
            script = [sys.executable, "-m", f"benchmarks.speed.{name}"]
            subprocess.run([*script, "--json", figures, *OPTIONS[name]], check=True, cwd=ROOT)
            found[name] = json.loads(figures.read_text(encoding="utf-8"))
        write(chosen.json, found)


if __name__ == "__main__":
    main()
