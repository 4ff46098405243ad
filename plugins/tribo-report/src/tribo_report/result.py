"""The report of a result."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from tribo import Body, Case, LabReport, Layer, Result
from tribo.kernel_api import (
    DataTable,
    Heading,
    TableRow,
    environment,
    lab_report,
    lab_sentences,
    plus_minus,
    provenance_rows,
    report_blocks,
    result_pictures,
    run_sentences,
    shown_in,
    to_toml,
)

from tribo_report.amounts import amount, component_words, part_words, value_words
from tribo_report.fields import charts
from tribo_report.page import render, stills
from tribo_report.sentence import Estimate, read_verified, sentence, trust

LONGEST_CASE = 200_000
"""Characters of a case that a report holds; one with a measured surface has millions."""
OF_A_BODY = ("surface", "material", "wear")
OF_A_CASE = ("load", "friction", "kinematics", "contact", "stepping")
"""Parts of a body, and of a case, that are put in words."""
STOPPED = "All are relative. A step that exceeds the limits of these stops a run."
CITATION = (
    "tribo {version}, MIT licence. Its model: J. Andersson, A. Almqvist and R. Larsson, "
    "Simulation of a wear experiment, 29 April 2010."
)


def result_page(result: Result, verified: Path | None = None) -> str:
    """Return the report of a result as HTML; see `tribo_report.write_report`."""
    lab, case = lab_report(result), result.case_tables
    estimates = [] if verified is None else read_verified(verified, result)
    return render(
        "result.html.j2",
        title=Path(result.name).stem,
        answer=sentence(result, lab, estimates),
        trust=trust(estimates),
        tables=_tables(result, lab, estimates),
        remarks=list(lab_sentences(result, lab)),
        notes=list(map(str, result.findings)),
        facts=facts(case),
        data=charts(result),
        stills=stills(result_pictures(result)),
        held=" ".join([*run_sentences(result), STOPPED]),
        provenance=list(provenance_rows(result)),
        citation=cited(result),
        case=case_text(case),
    )


def cited(result: Result) -> str:
    """Return how to cite what made a result."""
    return CITATION.format(version=result.provenance["packages"].get("tribo", ""))


def made_here() -> dict[str, Any]:
    """Return the packages that make a report, and how to cite it."""
    packages: Any = environment()["packages"]
    citation = CITATION.format(version=packages.get("tribo", ""))
    return {"provenance": [("report made with", versions(packages))], "citation": citation}


def versions(packages: Mapping[str, str]) -> str:
    """Return packages and their versions in words."""
    return ", ".join(f"{name} {version}" for name, version in packages.items())


def _tables(result: Result, lab: LabReport, estimates: Sequence[Estimate]) -> list[DataTable]:
    """Return the tables of the lab report, and the uncertainties after what they are of."""
    tables = (block for block in report_blocks(result, lab) if isinstance(block, DataTable))
    saves, wear, *others = tables
    rows = [TableRow((row["name"], *_uncertainty(row))) for row in estimates]
    headings = list(map(Heading, ("", "value ± uncertainty", "%")))
    uncertain = DataTable("Numerical uncertainty at the end", headings, rows)
    return [wear, *([uncertain] if rows else []), saves, *others]


def _uncertainty(row: Estimate) -> tuple[str, str]:
    """Return a value with its uncertainty, and this in % of the value."""
    found, value = row["uncertainty"], row["value"]
    if found is None:
        return amount(value, row["unit"]), "diverges"
    unit, size = shown_in(row["unit"], np.array(value))
    both = " ± ".join(plus_minus(value / size, found / size))
    # Around a sum, before a power of ten.
    both = f"({both})" if unit.startswith("10") else both
    return f"{both} {unit}".strip(), f"{100 * found / abs(value):.2g}" if value else ""


def facts(case: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Return the numbers of a case in words, by what they are of."""
    found = []
    for name, body in case["bodies"].items():
        found += [(f"{name}, {part}", part_words(Body, part, body.get(part))) for part in OF_A_BODY]
        for i, layer in enumerate(body.get("layers") or (), start=1):
            found.append((f"{name}, layer {i} from the top", value_words(layer, Layer)))
    found += [(part, part_words(Case, part, case.get(part))) for part in OF_A_CASE]
    grid = case.get("grid", {})
    if "size" in grid and "cells" in grid:
        size = " × ".join(f"{1e3 * edge:.4g}" for edge in grid["size"])
        cells = " × ".join(map(str, grid["cells"]))
        found.append(("window", f"{size} mm, {cells} cells"))
    found += [("effect", component_words(effect)) for effect in case.get("effects") or ()]
    return [(name, words) for name, words in found if words]


def case_text(case: Mapping[str, Any]) -> str:
    """Return a case as TOML, or a sentence if it is too long for a report."""
    text = to_toml(case)
    if len(text) <= LONGEST_CASE:
        return text
    return (
        f"# This case has {len(text):,} characters, with the heights of a surface in it; the "
        "result file holds it whole.\n"
    )
