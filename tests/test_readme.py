"""The README: its Python runs, and the output it shows is what the demo prints."""

import re
from pathlib import Path

import pytest
from click.testing import CliRunner

from tribo.cli.main import tribo

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\w*)\n(.*?)^```$", README, re.S | re.M)
CODE = [text for kind, text in BLOCKS if kind == "python"]
SHOWN = [text for kind, text in BLOCKS if kind == "text"]
WALL_TIME = re.compile(r"\d+\.\d s\.")
ROUND_OFF = re.compile(r"\de[-+]\d+")


def test_it_gives_the_two_commands():
    assert [text for kind, text in BLOCKS if not kind] == [
        "pip install . && tribo demo\n",
        "pip install -r requirements-dev.txt && pytest\n",
    ]


@pytest.mark.slow
@pytest.mark.parametrize("number", range(len(CODE)))
def test_its_python_runs(number, monkeypatch, capsys):
    monkeypatch.chdir(ROOT)
    exec(compile(CODE[number], f"README.md, block {number}", "exec"), {"__name__": "readme"})
    assert capsys.readouterr().out


@pytest.mark.slow
def test_it_shows_what_the_demo_prints(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "80")
    printed = CliRunner().invoke(tribo, ["demo"], catch_exceptions=False)
    assert printed.exit_code == 0
    (shown,) = SHOWN
    assert _comparable(shown) == _comparable(printed.stdout)


def test_its_pictures_are_small():
    pictures = re.findall(r"\]\((docs/images/[^)]+)\)", README)
    assert pictures
    for picture in pictures:
        assert 0 < (ROOT / picture).stat().st_size < 150_000


def _comparable(text):
    """Lines without what differs from run to run: wall time, round-off, trailing space."""
    lines = [line.rstrip() for line in text.strip().splitlines()]
    return [ROUND_OFF.sub("…", WALL_TIME.sub("… s.", line)) for line in lines]
