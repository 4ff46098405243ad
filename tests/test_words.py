"""How pages, docstrings and messages are written: the field's words, short lines and sentences."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
GENERATED = ("_generated", "jupyter_execute", "_build", "plugin_api.md")
PAGES = [
    page
    for folder in (ROOT / "docs", ROOT / "plugins", ROOT / "examples", ROOT / "benchmarks")
    for page in sorted(folder.rglob("*.md"))
    if not any(part in str(page) for part in (*GENERATED, ".venv", "site-packages", "templates"))
]
SOURCES = [ROOT / "tribo", *sorted((ROOT / "plugins").glob("*/src"))]
FOLDERS = sorted({path.parent for source in SOURCES for path in source.rglob("*.py")})
FORBIDDEN = re.compile(
    r"(?<![.\w])(that of|those of|one that|comes? to|is told|goes on|on the mean|in sum|anew"
    r"|could be had|at hand|notices?|doubts?)\b",
    re.IGNORECASE,
)
MEAN_WORDS, LONG_WORDS, LONG_SHARE = 22, 30, 0.1


def prose(text):
    """Return the sentences of a page, without code, tables, headings and formulas."""
    text = re.sub(r"\A---\n.*?^---\n", "", text, flags=re.S | re.M)
    text = re.sub(r"^( *)(```|~~~).*?^\1\2", "", text, flags=re.S | re.M)
    text = re.sub(r"\$\$.*?\$\$", "\n\n", text, flags=re.S)
    text = re.sub(r"\$[^$]*\$|`[^`]*`", "code", text)
    text = re.sub(r"\]\([^)]*\)", "]", text)
    kept = [line for line in text.split("\n") if not re.match(r"\s*(\||#|:::|<)|    ", line)]
    text = re.sub(r"^\s*([-*]|\d+\.|:) ", "\n\n", "\n".join(kept), flags=re.M)
    text = re.sub(r"(?<!\n)\n(?!\n)", " ", text)
    parts = re.split(r"\n\s*\n|(?<=[\w)*\]%]{2}[.?!:;]) +", text)
    return [part for part in parts if len(part.split()) > 2]


def _name(page):
    return str(page.relative_to(ROOT))


@pytest.mark.parametrize("page", PAGES, ids=_name)
def test_page_uses_the_words_of_the_style(page):
    found = [
        match.group()
        for each in prose(page.read_text("utf-8"))
        for match in FORBIDDEN.finditer(each)
    ]
    assert not found


def texts(source):
    """Yield the comments of a module, and its docstrings and messages: texts of several words."""
    yield " ".join(re.findall(r"(?:^|\s)#(.*)", source)).split()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.value.split()


@pytest.mark.parametrize("folder", FOLDERS, ids=_name)
def test_code_uses_the_words_of_the_style(folder):
    assert not [
        (path.name, match.group())
        for path in folder.glob("*.py")
        for words in texts(path.read_text("utf-8"))
        if len(words) > 1
        for match in re.finditer(rf".{{,40}}{FORBIDDEN.pattern}.{{,40}}", " ".join(words), re.I)
    ]


@pytest.mark.parametrize("page", PAGES, ids=_name)
def test_page_has_short_sentences_and_lines(page):
    text = page.read_text(encoding="utf-8")
    lengths = [len(sentence.split()) for sentence in prose(text)]
    if lengths:
        assert sum(lengths) / len(lengths) <= MEAN_WORDS
        assert sum(length > LONG_WORDS for length in lengths) <= 1 + LONG_SHARE * len(lengths)
    text = re.sub(r"^( *)```.*?^\1```|\$\$.*?\$\$", "", text, flags=re.S | re.M)
    long = [line for line in text.split("\n") if len(line) > 100 and not line.startswith("    ")]
    assert not [line for line in long if line[0] != "|" and "](" not in line]


def test_the_lint_finds_what_it_forbids():
    assert FORBIDDEN.search("It is that of a wave.")
    docstring, message = "'Return that of\\n    a wave.'", "raise ValueError('it goes on')"
    found = [FORBIDDEN.search(" ".join(words)) for words in texts(f"{docstring}\n{message}")]
    assert sum(map(bool, found)) == 2
    assert [
        len(each.split())
        for each in prose("One two three four. Five six seven.\n\n```\ncode\n```\n")
    ] == [4, 3]
