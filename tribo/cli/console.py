"""Tables and styled text on the terminal; control characters from files become escapes."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable
from typing import Any

from rich import box
from rich.console import Console as RichConsole
from rich.console import ConsoleOptions, RenderableType
from rich.markup import escape
from rich.segment import Segment
from rich.table import Table

from tribo.cli.streams import harmless
from tribo.core.data_table import LEFT, DataTable


class Console(RichConsole):
    """A console whose own styles are the only escape sequences that it prints."""

    def __init__(self, **options: Any) -> None:
        super().__init__(**{"highlight": False, **options})

    def render(
        self, renderable: RenderableType, options: ConsoleOptions | None = None
    ) -> Iterable[Segment]:
        """Yield what is printed, piece by piece."""
        for text, style, control in super().render(renderable, options):
            yield Segment(text if control else harmless(text), style, control)

    def _render_buffer(self, buffer: Iterable[Segment]) -> str:
        """Return what is written, without the blanks at the ends of lines."""
        return re.sub(" +$", "", super()._render_buffer(buffer), flags=re.MULTILINE)

    def table(self, table: DataTable) -> None:
        """Print a table, and its notes.

        No number is cut: a table may be wider than the terminal.
        """
        drawn = _drawn(table)
        least = self.measure(drawn, options=self.options.update(width=sys.maxsize)).minimum
        if least > self.width:
            drawn.width = least
        self.print(drawn, crop=False)
        for note in table.notes:
            self.print(note, markup=False)


def _drawn(table: DataTable) -> Table:
    """Return a table in the house style: a long heading is broken before a number is."""
    title = escape(table.title) if table.title else None
    drawn = Table(title=title, title_justify="left", title_style="bold", box=box.SIMPLE_HEAD)
    drawn.pad_edge, drawn.collapse_padding = not table.dense, table.dense
    rows = table.cells()
    for place, heading in enumerate(table.headings):
        words = (word for row in rows if row[1:] for word in row[place].split())
        drawn.add_column(
            escape(str(heading)),
            justify="left" if heading.form == LEFT or (table.named and not place) else "right",
            overflow="fold",
            no_wrap=heading.whole,
            min_width=max(map(len, words), default=0) if place else None,
        )
    for name, *values in rows:
        if values:
            drawn.add_row(escape(name), *map(escape, values))
        else:
            drawn.add_section()
            drawn.add_row(f"[bold]{escape(name)}[/]")
    return drawn
