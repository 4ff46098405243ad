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


def titled(title: str, *columns: str) -> Table:
    """Return an empty table in the house style: a column of names, and those of values.

    A heading that is too long is broken before a number is.
    """
    table = Table(title=title, title_justify="left", title_style="bold", box=box.SIMPLE_HEAD)
    if columns:
        table.add_column("", overflow="fold")
    for column in columns:
        table.add_column(escape(column), justify="right", overflow="fold")
    return table
