"""A table as data: a terminal, a notebook and a report print it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape
from math import isnan
from typing import TYPE_CHECKING, NamedTuple

from tribo.core.words import readable

if TYPE_CHECKING:
    import pandas as pd

LEFT = "<"
"""Format of a column of sentences, which begin at its left."""
NOTHING = "–"
"""Printed for a missing value."""
Value = float | str | None


class Heading(NamedTuple):
    """The heading of a column: label, "" for the rows' names, and unit and format of its numbers.

    A column that is `whole` is not broken into lines. `name` is the label where the title of the
    table is missing.
    """

    label: str
    unit: str = ""
    form: str = ""
    whole: bool = False
    name: str = ""

    def __str__(self) -> str:
        """Return the label above the unit."""
        return "\n".join(filter(None, (self.label, self.unit)))


class TableRow(NamedTuple):
    """The values of a row, None or NaN where missing; a single one titles the rows below.

    The format of its numbers is `form`, or else the format of their columns.
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

    A row of which nothing but the name is known is not printed. On a terminal the columns of a
    `dense` table stand closer.
    """

    title: str
    headings: Sequence[Heading]
    rows: Sequence[TableRow]
    notes: Sequence[str] = ()
    dense: bool = False

    @property
    def named(self) -> bool:
        """Whether each row begins with a name."""
        return all(isinstance(row.values[0], str) for row in self.rows)

    def cells(self) -> list[list[str]]:
        """Return the rows as text."""
        forms = [heading.form for heading in self.headings]
        rows = (
            [_text(value, row.form or form) for value, form in zip(row.values, forms, strict=False)]
            for row in self.rows
        )
        return [row for row in rows if set(row[1:]) != {NOTHING}]

    def to_dataframe(self) -> pd.DataFrame:
        """Return the rows, all digits of their numbers, with names and units: ``"time (s)"``."""
        import pandas as pd

        names = [(each.name or each.label, each.unit) for each in self.headings]
        columns = [f"{name} ({unit})" if unit else name for name, unit in names]
        return pd.DataFrame([row.values for row in self.rows], columns=columns)

    def html(self) -> str:
        """Return the headings and the rows as an HTML table."""
        heads = map(str, self.headings)
        lines = ["".join(f'<th scope="col">{escape(h)}</th>' if h else "<td></td>" for h in heads)]
        kind = 'th scope="row"' if self.named else "td"
        part = f'th scope="colgroup" class="part" colspan="{len(self.headings)}"'
        for name, *values in self.cells():
            first = f"<{kind if values else part}>{escape(name)}</{kind[:2]}>"
            lines.append(first + "".join(f"<td>{escape(value)}</td>" for value in values))
        head, *body = (f"<tr>{line}</tr>\n" for line in lines)
        return f"<table>\n<thead>{head}</thead>\n<tbody>{''.join(body)}</tbody>\n</table>"

    def _repr_html_(self) -> str:
        """Show the table in a notebook, with its title and notes."""
        notes = "".join(f"<p>{escape(note)}</p>" for note in self.notes)
        return f"<h4>{escape(self.title)}</h4>{self.html()}{notes}"


def _text(value: Value, form: str) -> str:
    if isinstance(value, str):
        return value
    return NOTHING if value is None or isnan(value) else readable(value, form)
