"""Write what finds each mutant: python tests/verification/found.py [names], an hour for all.

Each mutant is made in a copy of the sources. The cases that call its function are tried, quick ones
first, up to a row that fails.
"""

import ast
import json
import os
import shutil
import subprocess
import sys
import tempfile
import tomllib
import warnings
from pathlib import Path
from time import process_time
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


def function_of(mutant: dict[str, str]) -> list[Any]:
    """Return the file and the first line of the innermost function around a mutant, or line 0."""
    source = (REPOSITORY / mutant["file"]).read_text(encoding="utf-8")
    line = source[: source.index(mutant["old"])].count("\n") + 1
    lines = [
        min([node.lineno, *(each.lineno for each in node.decorator_list)])
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.FunctionDef) and node.lineno <= line <= (node.end_lineno or 0)
    ]
    return [mutant["file"], max(lines, default=0)]


def called() -> dict[str, Any]:
    """Run every case; return by its name how long it took, and which functions it called."""
    from tribo.verification.suite import installed_cases

    calls: set[tuple[str, int]] = set()

    def note(frame: Any, event: str, _: Any) -> None:
        if event == "call":
            calls.add((frame.f_code.co_filename, frame.f_code.co_firstlineno))

    found = {}
    for case in installed_cases():
        calls.clear()
        begun = process_time()
        sys.setprofile(note)
        verdicts = {row.verdict for row in case.run()}
        sys.setprofile(None)
        assert "fails" not in verdicts, case.name
        seconds = process_time() - begun
        found[case.name] = [not case.expected.quick, seconds, sorted(calls)]
    return found


def finding(names: list[str]) -> dict[str, str]:
    """Return the first of some cases with a row that fails, and its quantity; nothing without."""
    from tribo.verification.suite import installed_cases

    cases = {case.name: case for case in installed_cases()}
    for name in names:
        for row in cases[name].run():
            if row.verdict == "fails":
                return {"case": name, "quantity": row.quantity}
    return {}


def main() -> None:
    """Try every mutant, or those named, and write the table."""
    every = mutants()
    known = json.loads(TABLE.read_text(encoding="utf-8")) if TABLE.exists() else []
    rows = {row["mutant"]: row for row in known}
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place).resolve()
        environment = copied(folder)
        reach = asked(folder, environment, "called")
        for mutant in every:
            name, file = mutant["name"], mutant["file"]
            if sys.argv[1:] and name not in sys.argv[1:]:
                continue
            own = [str(folder / file), function_of(mutant)[1]]
            callers = [case for case in reach if own in reach[case][2] or own[1] == 0]
            (folder / file).write_text(mutated(mutant), encoding="utf-8")
            found = asked(folder, environment, *sorted(callers, key=lambda case: reach[case][:2]))
            shutil.copy2(REPOSITORY / file, folder / file)
            rows[name] = {"mutant": name, "file": file, **found}
            print(f"{name}: {found or len(callers)}", flush=True)
            lines = [
                json.dumps(rows[m["name"]], ensure_ascii=False) for m in every if m["name"] in rows
            ]
            TABLE.write_text("[\n" + ",\n".join(lines) + "\n]\n", encoding="utf-8")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--on"]:
        warnings.simplefilter("ignore")
        import tribo

        assert tribo.__file__.startswith(sys.argv[2])
        print(json.dumps(called() if sys.argv[3] == "called" else finding(sys.argv[3:])))
    else:
        main()
