"""The gallery of published tests: each case is valid, and has a page that is listed."""

from pathlib import Path

import pytest

from tribo import load_case

ROOT = Path(__file__).parents[2]
PAGES = ROOT / "docs" / "gallery"
CASES = {path.stem: path for path in (ROOT / "examples" / "gallery").glob("*.toml")} | {
    path.parent.name: path
    for path in (ROOT / "tribo" / "verification" / "cases").glob("*/case.toml")
    if (PAGES / f"{path.parent.name}.md").exists()
}
INDEX = (PAGES / "index.md").read_text(encoding="utf-8")
# The pages of packages are copied among the others when the documents are built.
OF_PACKAGES = {page.name: page for page in ROOT.glob("plugins/*/docs/gallery/*.md")}
TESTS = {page.name: page for page in PAGES.glob("*.md") if page.stem != "index"} | OF_PACKAGES


@pytest.mark.parametrize("case", CASES)
def test_a_case_is_valid_and_has_a_page(case):
    assert len(load_case(CASES[case]).bodies) == 2
    assert f"{case}.md" in TESTS


@pytest.mark.parametrize("page", TESTS.values(), ids=TESTS)
def test_a_page_is_listed_and_says_what_was_published_and_where_the_two_differ(page):
    text = page.read_text(encoding="utf-8")
    assert "## Published" in text
    assert "## Where the two differ" in text
    link = page.name if page.parent == PAGES else f"../../{page.relative_to(ROOT).as_posix()}"
    assert f"({link})" in INDEX
    assert f"\n{page.stem}\n" in INDEX
