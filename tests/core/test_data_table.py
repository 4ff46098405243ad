"""A table as data, on the terminal and as HTML."""

import io
from math import nan

import pytest

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
    assert TABLE.columns({0, 2}).cells() == [["at 0 s"], ["<b>", "[whole]"]]


def test_html_and_terminal_print_the_same_cells_as_they_are():
    html = TABLE.html()
    assert '<th scope="row">&lt;b&gt;</th><td>3.0</td><td>[whole]</td>' in html
    assert 'colspan="3">at 0 s</th>' in html
    console = Console(file=io.StringIO(), width=40)
    console.table(TABLE)
    last = console.file.getvalue().strip().splitlines()[-1]
    assert last.split() == ["<b>", "3.0", "[whole]"]


@pytest.mark.parametrize(("width", "left_out"), [(60, []), (24, ["b"]), (12, ["b", "a"])])
def test_a_narrow_terminal_leaves_out_what_can_be_spared_in_order(width, left_out):
    headings = (
        Heading("time", whole=True),
        Heading("a", whole=True, spare=2),
        Heading("b", whole=True, spare=1),
    )
    console = Console(file=io.StringIO(), width=width)
    console.table(DataTable("", headings, (TableRow(("1234567", "1" * 8, "2" * 8)),)))
    text = console.file.getvalue()
    assert ("2" * 8 not in text, "1" * 8 not in text) == ("b" in left_out, "a" in left_out)
    assert "1234567" in text
