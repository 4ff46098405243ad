"""Tables and styled text on the terminal; control characters from files become escapes."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any

from rich import box
from rich.console import Console as RichConsole
from rich.console import ConsoleOptions, RenderableType
from rich.markup import escape
from rich.segment import Segment
from rich.table import Table

from tribo.cli.streams import harmless
from tribo.core.data_table import DataTable

WIDE = 10_000
"""More characters than any table needs."""


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
        """Print a table and its notes; if it is too wide, without columns that it can spare."""
        spare = [i for i, heading in enumerate(table.headings) if heading.spare]
        spare.sort(key=lambda i: table.headings[i].spare)
        kept, unbounded = set(range(len(table.headings))), self.options.update(width=WIDE)
        left_out, drawn = [], _drawn(table)
        for i in spare:
            if self.measure(drawn, options=unbounded).minimum <= self.width:
                break
            left_out.append(table.headings[i].label)
            kept.remove(i)
            drawn = _drawn(table.columns(kept))
        self.print(drawn)
        if left_out:
            self.print(f"Left out for want of width: {', '.join(left_out)}.")
        for note in table.notes:
            self.print(note, markup=False)


def _drawn(table: DataTable) -> Table:
    """Return a table in the house style: a heading that is too long is broken before a number."""
    title = escape(table.title) if table.title else None
    drawn = Table(title=title, title_justify="left", title_style="bold", box=box.SIMPLE_HEAD)
    rows = table.cells()
    for i, heading in enumerate(table.headings):
        words = (word for row in rows if row[1:] for word in row[i].split())
        drawn.add_column(
            escape(str(heading)),
            justify="right" if i or heading.label else "left",
            overflow="fold",
            no_wrap=heading.whole,
            min_width=max(map(len, words), default=0) if i else None,
        )
    for row in rows:
        if not row[1:]:
            drawn.add_section()
            row = [f"[bold]{escape(row[0])}[/]"]
        else:
            row = list(map(escape, row))
        drawn.add_row(*row)
    return drawn
