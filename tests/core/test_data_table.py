"""A table as data, on the terminal and as HTML."""

import io
from math import nan

from tribo.cli.console import Console
from tribo.core.data_table import DataTable, Heading, TableRow

ROWS = (
    TableRow(("at 0 s",)),
    TableRow.scaled("depth, µm", (1.25e-6, None), 1e6, ".2f"),
    TableRow(("nothing known", None, nan)),
    TableRow(("<b>", 3.0, "[whole]")),
)
TABLE = DataTable("Title", (Heading(""), Heading("a", "mm", ".1f"), Heading("b")), ROWS)


def test_cells_have_the_format_of_their_row_or_column_and_a_dash_where_missing():
    assert TABLE.cells() == [["at 0 s"], ["depth, µm", "1.25", "–"], ["<b>", "3.0", "[whole]"]]


def test_html_and_terminal_print_the_same_cells_as_they_are():
    html = TABLE.html()
    assert '<th scope="row">&lt;b&gt;</th><td>3.0</td><td>[whole]</td>' in html
    assert 'colspan="3">at 0 s</th>' in html
    console = Console(file=io.StringIO(), width=40)
    console.table(TABLE)
    last = console.file.getvalue().strip().splitlines()[-1]
    assert last.split() == ["<b>", "3.0", "[whole]"]
