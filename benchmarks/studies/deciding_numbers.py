"""Numbers at module level that decide something, each with its source or its trial.

Counted is each name that a module of the kernel or of a package assigns and whose value holds a
number. Left out are:

- units of measure: `tribo/units.py` and `tribo/core/units.py`;
- inputs of the validation cases (folders `cases`) and of the conformance kit (`samples.py`);
- declarations, which name what they declare, so that the value holds a text too: a field or a type
  with its limits, a column of a table with its unit, the look of a line;
- sizes of pictures, whose note gives them in mm, px or inches;
- the numbers of a file format and of the contract with plugins: `FORMAT`, `api_version`;
- zero, and the integers 1 and −1, which are indices, axes and signs.

The source of a number is the note beside it: a comment or the text below it.

    python -m benchmarks.studies.deciding_numbers
"""

from __future__ import annotations

import ast
import re
from collections import Counter
from collections.abc import Iterator
from itertools import zip_longest
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[2]
INPUTS = {"cases", "samples.py", "units.py"}
VERSIONS = {"FORMAT", "api_version"}
SIZE = re.compile(r"\bin (mm|px|inches)\b")


class Number(NamedTuple):
    """A name that holds a number: where it is, its value, and the note beside it."""

    path: str
    name: str
    value: str
    note: str


def decides(value: ast.expr) -> bool:
    """Return whether an assigned value holds a number and no text."""
    held = [node.value for node in ast.walk(value) if isinstance(node, ast.Constant)]
    numbers = [x for x in held if isinstance(x, (int, float)) and not isinstance(x, bool)]
    telling = [x for x in numbers if x != 0 and (isinstance(x, float) or x != 1)]
    return bool(telling) and not any(isinstance(x, str) for x in held)


def note_of(lines: list[str], node: ast.stmt, after: ast.stmt | None) -> str:
    """Return the comment above or beside an assignment, or the text below it."""
    first = node.lineno - 1
    while lines[first - 1].startswith("#"):
        first -= 1
    comments = lines[first : node.end_lineno]
    words = [line.partition("# ")[2] for line in comments if "# " in line]
    if (
        isinstance(after, ast.Expr)
        and isinstance(after.value, ast.Constant)
        and isinstance(after.value.value, str)
    ):
        words.append(after.value.value)
    return " ".join(" ".join(words).split())


def numbers_of(path: Path) -> Iterator[Number]:
    """Yield the numbers of a module that decide something."""
    text = path.read_text(encoding="utf-8")
    body = ast.parse(text).body
    for node, after in zip_longest(body, body[1:]):
        if not isinstance(node, (ast.Assign, ast.AnnAssign)) or node.value is None:
            continue
        note = note_of(text.splitlines(), node, after)
        target = node.targets[0] if isinstance(node, ast.Assign) else node.target
        pairs = [(target, node.value)]
        if isinstance(target, ast.Tuple) and isinstance(node.value, ast.Tuple):
            pairs = list(zip(target.elts, node.value.elts, strict=True))
        for name, value in pairs:
            called = ast.unparse(name)
            if decides(value) and called not in VERSIONS and not SIZE.search(note):
                yield Number(path.relative_to(ROOT).as_posix(), called, ast.unparse(value), note)


def numbers() -> list[Number]:
    """Return the numbers of the kernel and of the packages that decide something."""
    roots = (ROOT / "tribo", *ROOT.glob("plugins/*/src"))
    paths = sorted(path for root in roots for path in root.rglob("*.py"))
    kept = (path for path in paths if not INPUTS & set(path.relative_to(ROOT).parts))
    return [number for path in kept for number in numbers_of(path)]


def main() -> None:
    """Print each number with its note, the count of each distribution, and what has no note."""
    counted = numbers()
    for number in counted:
        print(f"{number.path}: {number.name} = {number.value}\n    {number.note or 'NO SOURCE'}")
    count = Counter(
        parts[1] if parts[0] == "plugins" else "tribo"
        for parts in (number.path.split("/") for number in counted)
    )
    for distribution, number in count.most_common():
        print(f"{distribution:20} {number:4}")
    print(f"{'all':20} {len(counted):4}")
    bare = [f"{number.path}: {number.name}" for number in counted if not number.note]
    print(f"without a source: {len(bare)}", *bare, sep="\n    ")


if __name__ == "__main__":
    main()
