"""The report of a sweep."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from tribo import CaseError, Result
from tribo.kernel_api import (
    cell,
    column_heading,
    is_text,
    labelled,
    runs_table,
    sweep_pictures,
    varied_paths,
)

from tribo_report.page import render, stills
from tribo_report.reduced import each_plain
from tribo_report.result import case_text, cited, facts, versions
from tribo_report.sentence import quoted

RUNS, RESULTS = "runs.csv", "results"
DECADE = 10.0
"""Ratio of the ends from which an axis is logarithmic, as in the kernel's histories."""
MEASURES = ("wear_volume_m3", "max_wear_depth_m", "scar_across_m")


def sweep_page(folder: Path) -> str:
    """Return the report of the sweep in a folder as HTML; see `tribo_report.write_report`."""
    try:
        runs = pd.read_csv(folder / RUNS)
        done = runs[runs["status"] == "done"]
        if done.empty:
            raise CaseError(f"no run of {folder} is done; there is nothing to report")
        # What is a number first: it makes the better axis.
        names = sorted(varied_paths(runs), key=partial(is_text, done))
        first = done.iloc[0]["file"]
    except (OSError, ValueError, KeyError) as error:
        raise CaseError(f"{folder / RUNS} is not the table of a sweep: {error}") from error
    with Result.open(folder / RESULTS / str(first)) as result:
        bodies, citation, case = result.body_names, cited(result), result.case_tables
        made = versions(result.provenance["packages"])
    measures = [
        column
        for column in (*(f"bodies.{b}.{m}" for m in MEASURES for b in bodies), "max_pressure_Pa")
        if column in done and np.any(done[column] != 0)
    ]
    pictures = sweep_pictures(done, names, measures)
    return render(
        "study.html.j2",
        kind="Sweep",
        title=folder.name,
        answers=list(_answers(done, len(runs), names, bodies)),
        tables_title="The runs",
        tables=[runs_table(runs, measures)],
        notes=list(_notes(runs)),
        curves_title="What varies, and what comes of it",
        stills=stills({_words(name, done): draw for name, draw in pictures.items()}),
        provenance=[("folder", str(folder.name)), ("made with", made)],
        citation=citation,
        case=case_text(case),
        whose=f" of run {done.iloc[0]['run']}",
        facts=facts(case),
        data={"history": _curves(done, names, measures)},
    )


def _answers(
    done: pd.DataFrame, count: int, varied: list[str], bodies: tuple[str, ...]
) -> Iterator[str]:
    """Say between which ends each body's wear lies, and in which runs."""
    yield f"{len(done)} of {count} runs are done."
    for body in bodies:
        volumes = done[f"bodies.{body}.wear_volume_m3"]
        if not volumes.max() > 0:
            continue
        ends = []
        for index in (volumes.idxmin(), volumes.idxmax()):
            row = done.loc[index]
            depth = quoted(row[f"bodies.{body}.max_wear_depth_m"], "µm")
            where = ", ".join(
                f"{_words(name, done)} {_with_unit(name, done, index)}" for name in varied
            )
            ends.append(
                f"{quoted(row[f'bodies.{body}.wear_volume_m3'], 'mm³')}, {depth} deep (run "
                f"{row['run']}: {where})"
            )
        yield f"The {body} lost {' to '.join(dict.fromkeys(ends))}."


def _notes(runs: pd.DataFrame) -> Iterator[str]:
    """Yield once what several runs have to say with other numbers."""
    found = runs[runs["message"].notna()]
    alike = found["message"].astype(str).str.replace(r"[\d.]+", "", regex=True)
    for _, rows in found.groupby(alike, sort=False):
        numbers, text = list(rows["run"]), rows["message"].iloc[0]
        more = f" and {len(numbers) - 1} more" if len(numbers) > 1 else ""
        yield f"run {numbers[0]}{more}: {text}"


def _words(name: str, runs: pd.DataFrame) -> str:
    return labelled(name, runs)[0]


def _with_unit(name: str, runs: pd.DataFrame, index: Any) -> str:
    return f"{cell(name, runs, index)} {labelled(name, runs)[1]}".rstrip()


def _curves(done: pd.DataFrame, varied: list[str], measures: list[str]) -> dict[str, Any]:
    """Return measures over each quantity that varies, a curve for each of the others."""
    axes = []
    for across in varied:
        words, _, factor = labelled(across, done)
        groups = _groups(done.sort_values(across), [name for name in varied if name != across])
        text = is_text(done, across)
        low, high = (0.0, 0.0) if text else (done[across].min(), done[across].max())
        panels = []
        for name in measures:
            what, unit, size = labelled(name, done)
            curves = [
                {
                    "name": called,
                    "x": list(rows[across]) if text else each_plain(rows[across] / factor),
                    "y": each_plain(rows[name] / size),
                }
                for called, rows in groups.items()
            ]
            panel = {"name": what, "unit": unit, "log": False, "curves": curves}
            panels.append(panel | {"note": "A mark for each run that is done, at its end."})
        log = bool(low > 0 and high >= DECADE * low)
        label = column_heading(across, done).label
        axes.append({"name": words, "label": label, "log": log, "panels": panels})
    return {"axes": axes}


def _groups(runs: pd.DataFrame, others: list[str]) -> dict[str, pd.DataFrame]:
    """Return the runs of each curve by name."""
    names = [name for name in others if runs[name].nunique() > 1]
    return {
        ", ".join(f"{_words(n, runs)} {_with_unit(n, runs, rows.index[0])}" for n in names): rows
        for _, rows in (runs.groupby(names, sort=True) if names else [("", runs)])
    }
