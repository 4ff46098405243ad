"""The table of a sweep, made from its results: one row per run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pandas

from tribo.case import Case
from tribo.config.overrides import leaves_at
from tribo.core.column import labelled
from tribo.core.errors import CaseError
from tribo.lab.report import lab_report
from tribo.result.read import Result
from tribo.simulation.validity import unusual


@dataclass(frozen=True)
class Run:
    """A run of a sweep: its number from 1, its settings in words, its case, its result file.

    Examples
    --------
    >>> from pathlib import Path
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides="load.normal=50 N")
    >>> run = tribo.Run(2, "load.normal = 50 N", case, Path("results/2.h5"))
    >>> run.case.load.normal
    50.0
    """

    number: int
    label: str
    case: Case
    path: Path


def runs_table(
    runs: Sequence[Run], paths: Sequence[str], failures: Mapping[str, str]
) -> pandas.DataFrame:
    """Return a row for each run.

    A table or list at one of `paths`, which vary, has a column for each value in it. `failures` are
    the reasons by the names of the runs' files.
    """
    rows = []
    for run in runs:
        leaves = [leaf for path in paths for leaf in leaves_at(run.case, path)]
        varied = {labelled(name, unit): value for name, value, unit in leaves}
        row = {"run": run.number, "status": "waiting", **varied}
        message = failures.get(run.path.name, "")
        if message:
            row["status"] = "failed"
        elif run.path.exists():
            try:
                with Result.open(run.path) as result:
                    message = "; ".join(map(str, [*unusual(run.case), *result.warnings]))
                    row["status"] = "done" if result.status == "done" else "interrupted"
                    if result.status == "done":
                        row |= _measured(result)
            except CaseError as error:
                row["status"], message = "interrupted", str(error)
        rows.append(row | {"file": run.path.name, "message": message})
    table = pandas.DataFrame(rows)
    if "steps" in table:
        table["steps"] = table["steps"].astype("Int64")
    last = ["file", "message"]
    return table[[*table.columns.difference(last, sort=False), *last]]


def _measured(result: Result) -> dict[str, Any]:
    """Return the scalars of the last save, and what a lab would report."""
    row: dict[str, Any] = {k: float(values[-1]) for k, values in result.table("saves").items()}
    lab, totals = lab_report(result).as_json(), result.totals()
    for name, body in lab["bodies"].items():
        row |= {f"bodies.{name}.{label}": value for label, value in body.items()}
    row |= {f"first_contact.{label}": value for label, value in lab["first_contact"].items()}
    row |= {each["key"]: each["value"] for each in lab["plugins"] if each["key"]}
    return row | {"steps": totals["steps"], "wall_time_s": totals["wall_time_s"]}
