"""The report of a comparison."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

from tribo import Comparison
from tribo.kernel_api import (
    comparison_picture,
    comparison_table,
    signed,
    time_labels,
    to_toml,
)

from tribo_report.curves import history, moments, sections, thinned
from tribo_report.fields import pressure_maps
from tribo_report.page import render, stills
from tribo_report.result import cited, facts
from tribo_report.sentence import quoted


def comparison_page(comparison: Comparison) -> str:
    """Return the report of results side by side as HTML; see `tribo_report.write_report`."""
    results, first = comparison.results, comparison.results[comparison.reference]
    times = [comparison.times[i] for i in thinned(len(comparison.times))]
    ends = comparison.chosen_times()
    saves = [first.save_at(time) for time in times]
    data = {
        "saves": moments(first, saves),
        "left_out": len(comparison.times) - len(times),
        "maps": pressure_maps(results, times),
        "surfaces": [],
        "sections": sections(results, times),
        "history": history(results),
    }
    table, varied = comparison_table(comparison, ends), comparison.varied
    title = " and ".join(results) if len(results) == 2 else f"{len(results)} results"
    return render(
        "study.html.j2",
        kind="Comparison",
        # A value alone does not say of what it is.
        title=f"{varied[0]}: {title}" if len(varied) == 1 else title,
        answers=_answers(comparison),
        tables_title="Side by side",
        tables=[replace(table, title="At the first and the last common save")],
        remarks=[*([f"Varied: {', '.join(varied)}."] if varied else []), _how_compared(comparison)],
        notes=[each.words for each in comparison.findings],
        has_moments=True,
        curves_title="History",
        stills=stills(
            {
                f"comparison at {time:g} s": partial(comparison_picture, results, time)
                for time in ends
            }
        ),
        provenance=_provenance(comparison),
        citation=cited(first),
        case=to_toml(first.case_tables),
        whose=f" of {comparison.reference}",
        facts=facts(first.case_tables),
        data=data,
    )


def _how_compared(comparison: Comparison) -> str:
    """Say what the percentages of the table are."""
    return (
        f"Percentages are relative to {comparison.reference}; for maps they are "
        "the L2 norm and the largest difference, which for a pressure often lies at the rim."
    )


def _answers(comparison: Comparison) -> list[str]:
    """Return the wear of bodies in the first result, and the differences of the others."""
    first, last = comparison.reference, comparison.times[-1]
    saves = {label: comparison.save(label, last) for label in comparison.results}
    time = time_labels(comparison.results[first].times)[comparison.results[first].save_at(last)]
    # Values stand for a variant, file names for a place.
    varied = comparison.varied
    of = f"{varied[0]} " if len(varied) == 1 else ""
    where = f"{'with' if comparison.settings else 'in'} {of}{first}"
    answers = []
    for body in comparison.bodies:
        worn = {label: save["bodies"][body] for label, save in saves.items()}
        if not worn[first]["wear_volume_m3"]:
            continue
        lost, deep = (
            f"{quoted(worn[first][key], unit)} ({_others(worn, key, first)})"
            for key, unit in (("wear_volume_m3", "mm³"), ("max_wear_depth_m", "µm"))
        )
        answers.append(f"After {time} the {body} has lost {lost} {where} and is worn {deep} deep.")
    return answers


def _others(worn: dict[str, dict[str, float]], key: str, first: str) -> str:
    """Return the differences of the others from the first, in percent."""
    parts = {label: 100 * (body[key] / worn[first][key] - 1) for label, body in worn.items()}
    del parts[first]
    return ", ".join(f"{label}: {signed(part, 1)} %" for label, part in parts.items())


def _provenance(comparison: Comparison) -> list[tuple[str, str]]:
    rows: list[tuple[str, str]] = []
    for label, result in comparison.results.items():
        settings: dict[str, Any] = dict(comparison.settings.get(label, {}))
        words = [result.name, *(f"{path} = {value}" for path, value in settings.items())]
        packages = result.provenance["packages"].items()
        words += [f"{name} {version}" for name, version in packages if name == "tribo"]
        rows.append((label, ", ".join(words)))
    return rows
