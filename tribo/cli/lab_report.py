"""The lab report of a result, and what made the result."""

from __future__ import annotations

from collections.abc import Iterator

from rich.markup import escape

from tribo.cli.console import Console
from tribo.core.data_table import DataTable
from tribo.lab.kept import fields_table
from tribo.lab.report import LabReport, lab_report, lab_sentences, run_sentences
from tribo.lab.tables import inferred_table, saves_table, wear_table
from tribo.result.read import Result


def print_report(result: Result, console: Console | None = None, *, warned: bool = False) -> None:
    """Print the saves, the worn bodies and the first contact of `result`.

    The warnings of its run are left out if they were printed while it ran, `warned`.
    """
    console, lab = console or Console(), lab_report(result)
    for block in report_blocks(result, lab):
        if isinstance(block, DataTable):
            console.table(block)
        else:
            console.print(block, markup=False)
    if words := status_words(result):
        console.print(f"[yellow]{escape(words)}[/]")
    told = [each for each in result.findings if warned and each.is_warning]
    for finding in result.findings:
        if finding not in told:
            console.print(f"[yellow]Note:[/] {escape(str(finding))}")


def report_blocks(result: Result, lab: LabReport) -> Iterator[DataTable | str]:
    """Yield the tables and then the sentences of a lab report, but for findings."""
    yield saves_table(result)
    yield wear_table(result, lab.bodies)
    if lab.inferred:
        yield inferred_table(lab.inferred)
    if (fields := fields_table(result)) is not None:
        yield fields
    yield from lab_sentences(result, lab)
    yield from run_sentences(result)


def status_words(result: Result) -> str:
    """Return how a run ended that is not done, and how to continue it; "" if it is done."""
    stopped = result.status in ("killed", "interrupted")
    remedy = f" To go on with it: tribo resume {result.name}" if stopped else ""
    return "" if result.status == "done" else f"This run is {result.status}, not done.{remedy}"


def provenance_rows(result: Result) -> Iterator[tuple[str, str]]:
    """Yield what made a result, by name: versions, where each model came from, what it states."""
    made = result.provenance
    for again in (made, *made.get("resumed_with", ())):
        packages = ", ".join(f"{name} {version}" for name, version in again["packages"].items())
        when = "made with" if again is made else "continued with"
        yield when, f"Python {again['python']}, {packages}"
        if begun := again.get("begun_with"):
            yield "begun with", f"{begun['result']}, SHA-256 {begun['sha256']}"
        for place, origin in again["components"].items():
            whose = f"{origin['distribution']} {origin['version']}".strip()
            where = f"{origin['class']} of {whose}" if whose else origin["class"]
            editable = ", editable" if origin["editable"] else ""
            code = f"source code {origin['code'][:10] or 'not available'}"
            facts = "".join(f"; {name}: {text}" for name, text in origin["facts"].items())
            yield place, f"{origin['type']}, {where}{editable}, {code}{facts}"
        for plugin in again["plugins"]:
            if plugin["status"] not in ("loaded", "available"):
                whose = f"plugin {plugin['distribution']} {plugin['version']}"
                yield whose, f"{plugin['status']}: {plugin['reason']}"
