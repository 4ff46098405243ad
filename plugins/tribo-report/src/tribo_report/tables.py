"""The tables of the terminal, for a page."""

from __future__ import annotations

from dataclasses import dataclass

from rich.table import Table
from rich.text import Text


@dataclass(frozen=True)
class PageTable:
    """A table of text: its title, its head, its rows, and whether each begins with a name."""

    title: str
    head: list[str]
    rows: list[list[str]]
    named: bool


def for_page(table: Table) -> PageTable:
    """Return what a table says, without the styles of the terminal."""
    head = [_text(column.header) for column in table.columns]
    columns = [[_text(cell) for cell in column.cells] for column in table.columns]
    rows = [list(row) for row in zip(*columns, strict=True)]
    title = "" if table.title is None else _text(table.title)
    return PageTable(title, head, rows, head[:1] == [""])


def _text(cell: object) -> str:
    return cell.plain if isinstance(cell, Text) else Text.from_markup(str(cell)).plain
