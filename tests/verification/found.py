"""Write what finds each mutant: python tests/verification/found.py [names], some hours for all.

Each mutant is made in a copy of the sources. The cases are tried, quick ones first, up to a row
that fails.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import tomllib
import warnings
from pathlib import Path
from typing import Any

REPOSITORY = Path(__file__).parents[2]
MUTANTS = Path(__file__).with_name("mutants.toml")
TABLE = REPOSITORY / "docs/_data/mutants.json"


def mutants() -> list[dict[str, str]]:
    """Return the mutants: name, file, text and what stands in its place."""
    return list(tomllib.loads(MUTANTS.read_text(encoding="utf-8"))["mutant"])


def mutated(mutant: dict[str, str]) -> str:
    """Return the file of a mutant with its mistake."""
    source = (REPOSITORY / mutant["file"]).read_text(encoding="utf-8")
    if source.count(mutant["old"]) != 1:
        raise ValueError(f"{mutant['name']}: its text must stand once in {mutant['file']}")
    return source.replace(mutant["old"], mutant["new"])


def copied(folder: Path) -> dict[str, str]:
    """Copy the sources, and return the environment in which the copy is imported."""
    places = ["tribo", *(str(p.relative_to(REPOSITORY)) for p in REPOSITORY.glob("plugins/*/src"))]
    for place in places:
        shutil.copytree(REPOSITORY / place, folder / place)
    paths = [str(folder), *(str(folder / place) for place in places[1:])]
    one = {"OPENBLAS_NUM_THREADS": "1", "PYTHONPATH": os.pathsep.join(paths)}
    return {**os.environ, **one}


def asked(folder: Path, environment: dict[str, str], *arguments: str) -> Any:
    """Return what this script, run in another process on the copy, answers."""
    command = [sys.executable, __file__, "--on", str(folder), *arguments]
    done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, check=True, text=True)
    return json.loads(done.stdout.splitlines()[-1])


def finding(names: list[str]) -> dict[str, str]:
    """Return the first case with a row that fails, and its quantity; nothing without.

    All cases are tried, quick ones first, or those of these names.
    """
    from tribo.verification.suite import installed_cases

    cases = (case for case in installed_cases() if case.name in (names or [case.name]))
    for case in sorted(cases, key=lambda case: not case.expected.quick):
        for row in case.run():
            if row.verdict == "fails":
                return {"case": case.name, "quantity": row.quantity}
    return {}


def main() -> None:
    """Try every mutant, or those named, and write the table."""
    every = mutants()
    known = json.loads(TABLE.read_text(encoding="utf-8")) if TABLE.exists() else []
    rows = {row["mutant"]: row for row in known}
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place).resolve()
        environment = copied(folder)
        for mutant in every:
            name, file = mutant["name"], mutant["file"]
            if sys.argv[1:] and name not in sys.argv[1:]:
                continue
            (folder / file).write_text(mutated(mutant), encoding="utf-8")
            found = asked(folder, environment)
            shutil.copy2(REPOSITORY / file, folder / file)
            rows[name] = {"mutant": name, "file": file, **found}
            print(f"{name}: {found}", flush=True)
            lines = [
                json.dumps(rows[m["name"]], ensure_ascii=False) for m in every if m["name"] in rows
            ]
            TABLE.write_text("[\n" + ",\n".join(lines) + "\n]\n", encoding="utf-8")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--on"]:
        warnings.simplefilter("ignore")
        import tribo

        assert tribo.__file__.startswith(sys.argv[2])
        print(json.dumps(finding(sys.argv[3:])))
    else:
        main()
