"""A table as data: a terminal, a notebook and a report print it."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace
from html import escape
from math import isnan
from typing import NamedTuple

from tribo.core.words import readable

NOTHING = "–"
"""What is printed for a missing value."""
Value = float | str | None


class Heading(NamedTuple):
    """The heading of a column.

    Parameters
    ----------
    label : str
        A noun phrase; "" for the column of the rows' names.
    unit : str, optional
        That of the column's numbers.
    form : str, optional
        Format of its numbers.
    whole : bool, optional
        Whether neither the heading nor a cell may be broken into lines.
    spare : int, optional
        Order in which a narrow terminal leaves the column out, from 1; 0 for never.
    """

    label: str
    unit: str = ""
    form: str = ""
    whole: bool = False
    spare: int = 0

    def __str__(self) -> str:
        """Return the label above the unit."""
        return "\n".join(filter(None, (self.label, self.unit)))


class TableRow(NamedTuple):
    """The values of a row, None or NaN where missing; one alone is the title of the rows below.

    The format of its numbers is `form`, or else that of their columns.
    """

    values: tuple[Value, ...]
    form: str = ""

    @classmethod
    def scaled(cls, name: str, values: Iterable[Value], factor: float, form: str) -> TableRow:
        """Return a row with the name of a quantity and its values times the factor to its unit."""
        numbers = (factor * v if isinstance(v, float | int) else v for v in values)
        return cls((name, *numbers), form)


@dataclass(frozen=True)
class DataTable:
    """A table: its title, a heading for each column, its rows, and sentences below it.

    A row of which nothing but the name is known is not printed.
    """

    title: str
    headings: tuple[Heading, ...]
    rows: tuple[TableRow, ...]
    notes: tuple[str, ...] = ()

    def cells(self) -> list[list[str]]:
        """Return the rows as text."""
        forms = [heading.form for heading in self.headings]
        return [
            [_text(value, row.form or form) for value, form in zip(row.values, forms, strict=False)]
            for row in self.rows
            if len(row.values) == 1 or any(map(_is_known, row.values[1:]))
        ]

    def columns(self, kept: Collection[int]) -> DataTable:
        """Return the table of some of the columns, by their index."""

        def of(row: TableRow) -> TableRow:
            values = tuple(value for i, value in enumerate(row.values) if i in kept)
            return row if len(row.values) == 1 else row._replace(values=values)

        headings = tuple(heading for i, heading in enumerate(self.headings) if i in kept)
        return replace(self, headings=headings, rows=tuple(map(of, self.rows)))

    def html(self) -> str:
        """Return the headings and the rows as an HTML table."""
        heads = map(str, self.headings)
        lines = ["".join(f'<th scope="col">{escape(h)}</th>' if h else "<td></td>" for h in heads)]
        for name, *values in self.cells():
            cells = "".join(f"<td>{escape(value)}</td>" for value in values)
            if not values:
                span = len(self.headings)
                first = f'<th scope="colgroup" class="part" colspan="{span}">{escape(name)}</th>'
            elif self.headings[0].label:
                first = f"<td>{escape(name)}</td>"
            else:
                first = f'<th scope="row">{escape(name)}</th>'
            lines.append(first + cells)
        head, *body = (f"<tr>{line}</tr>\n" for line in lines)
        return f"<table>\n<thead>{head}</thead>\n<tbody>{''.join(body)}</tbody>\n</table>"

    def _repr_html_(self) -> str:
        """Show the table in a notebook, with its title and notes."""
        notes = "".join(f"<p>{escape(note)}</p>" for note in self.notes)
        return f"<h4>{escape(self.title)}</h4>{self.html()}{notes}"


def _is_known(value: Value) -> bool:
    return isinstance(value, str) or (value is not None and not isnan(value))


def _text(value: Value, form: str) -> str:
    if value is None or isinstance(value, str):
        return NOTHING if value is None else value
    return NOTHING if isnan(value) else readable(value, form)
