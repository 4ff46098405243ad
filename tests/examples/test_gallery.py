"""The gallery of published tests: each case is valid, and has a page that is listed."""

from pathlib import Path

import pytest

from tribo import load_case

ROOT = Path(__file__).parents[2]
CASES = sorted((ROOT / "examples" / "gallery").glob("*.toml"))
PAGES = ROOT / "docs" / "gallery"


def test_there_are_at_least_ten():
    assert len(CASES) >= 10


@pytest.mark.parametrize("case", CASES, ids=lambda path: path.stem)
def test_a_case_is_valid_and_its_page_is_in_the_table_and_says_where_the_two_differ(case):
    assert len(load_case(case).bodies) == 2
    page = (PAGES / f"{case.stem}.md").read_text(encoding="utf-8")
    assert f"gallery/{case.name}" in page
    assert "## Published" in page
    assert "## Where the two differ" in page
    index = (PAGES / "index.md").read_text(encoding="utf-8")
    assert f"({case.stem}.md)" in index
    assert f"\n{case.stem}\n" in index
