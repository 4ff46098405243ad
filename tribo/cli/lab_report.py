"""The lab report of a result on the terminal, and what made the result."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from rich.markup import escape
from rich.text import Text

from tribo.cli.console import Console
from tribo.core.data_table import DataTable
from tribo.lab.kept import fields_table
from tribo.lab.report import LabReport, lab_report, lab_sentences, run_sentences
from tribo.lab.tables import lab_tables
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
    yield from lab_tables(result, lab)
    if (fields := fields_table(result)) is not None:
        yield fields
    yield from lab_sentences(result, lab)
    yield from run_sentences(result)


def status_words(result: Result) -> str:
    """Return how a run ended that is not done, and how to continue it; "" if it is done."""
    stopped = result.status in ("killed", "interrupted")
    remedy = f" To go on with it: tribo resume {result.name}" if stopped else ""
    return "" if result.status == "done" else f"This run is {result.status}, not done.{remedy}"


def print_provenance(result: Result, console: Console | None = None) -> None:
    """Print where each model of `result` came from, its configuration and what it states."""
    console = console or Console()
    made = result.provenance
    console.print()
    for again in (made, *made.get("resumed_with", ())):
        packages = ", ".join(f"{name} {version}" for name, version in again["packages"].items())
        console.print(
            f"{'Made' if again is made else 'Gone on'} with Python {again['python']}, {packages}; "
            "models, in SI units:",
            markup=False,
        )
        if begun := again.get("begun_with"):
            console.print(
                f"  begun with {begun['result']}, SHA-256 {begun['sha256']}", markup=False
            )
        for place, origin in again["components"].items():
            for line in _origin(place, origin):
                console.print(Text(line), soft_wrap=True)
        for plugin in again["plugins"]:
            if plugin["status"] not in ("loaded", "available"):
                console.print(
                    f"  plugin {plugin['distribution']} {plugin['version']} was "
                    f"{plugin['status']}: {plugin['reason']}",
                    markup=False,
                )


def _origin(place: str, origin: Mapping[str, Any]) -> Iterator[str]:
    whose = f"{origin['distribution']} {origin['version']}".strip()
    where = f"{origin['class']} of {whose}" if whose else origin["class"]
    editable = ", editable" if origin["editable"] else ""
    code = f", source code {origin['code'][:10]}" if origin["code"] else ", source not available"
    yield f"  {place}: {origin['type']}, {where}{editable}{code}"
    config = [
        f"{key} = {json.dumps(value, ensure_ascii=False)}"
        for key, value in origin["config"].items()
        if key != "type" and value is not None
    ]
    if config:
        yield f"      {', '.join(config)}"
    for name, text in origin["facts"].items():
        yield f"      {name}: {text}"
