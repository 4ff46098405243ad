"""The README: its Python runs, and the output it shows is what the demo prints."""

import json
import re
from pathlib import Path

import pytest
from click.testing import CliRunner
from made_results import empty_pictures

from tribo.cli.main import tribo

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\w*)\n(.*?)^```$", README, re.S | re.M)
CODE = [text for kind, text in BLOCKS if kind == "python"]
SHOWN = [text for kind, text in BLOCKS if kind == "text"]
WALL_TIME = re.compile(r"(?<=contact solves, )[\d.e-]+(?= s\.$)")
AVERAGE = re.compile(r"  (\w.*?)  +(\S+)  ")
QUICK = (
    "kinematics.positions=25",
    "grid.cells=24",
    "stepping.depth_tolerance=0.1",
    "stepping.pressure_tolerance=1",
    "stepping.settle=1",
)
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
@pytest.mark.filterwarnings("ignore:resolution")
def test_it_shows_what_the_demo_prints(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "80")
    empty_pictures(monkeypatch)
    # The resolved hour in a few seconds: its own column is masked.
    monkeypatch.setattr("tribo.cli.demo.RESOLVED", QUICK)
    printed = CliRunner().invoke(tribo, ["demo"], catch_exceptions=False)
    assert printed.exit_code == 0
    (shown,) = SHOWN
    assert _comparable(shown) == _comparable(printed.stdout)


def test_its_resolved_hour_is_that_of_the_page_on_the_paper():
    figures = (ROOT / "docs" / "_data" / "resolved_hour.json").read_text(encoding="utf-8")
    rows = json.loads(figures)["tables"]["resolved hour"]
    average, resolved = (
        next(row for row in rows if row["cells"] == 96 and row["positions"] == positions)
        for positions in ("average", 33)
    )
    for here, there, factor in (
        ("disk depth, µm", "groove_um", 1),
        ("ball depth, µm", "ball_um", 1),
        ("width along, µm", "along_mm", 1e3),
        ("centre pressure, MPa", "centre_MPa", 1),
    ):
        shown = re.search(rf"{here} +(\S+)(?: ± \S+)? +(\S+)", README).groups()
        known = [factor * average[there], factor * resolved[there]]
        # The demo's grid of 64² cells leaves the pressure 2 % off.
        assert [float(value) for value in shown] == pytest.approx(known, rel=0.025)


def test_its_pictures_are_small():
    pictures = re.findall(r"\]\((docs/images/[^)]+)\)", README)
    assert pictures
    for picture in pictures:
        assert 0 < (ROOT / picture).stat().st_size < 150_000


def _comparable(text):
    """Lines without what differs from run to run: wall time, round-off, trailing space.

    Of the last table, whose resolved column is masked, names and averages are left.
    """
    head, _, rest = text.strip().partition('("What the average costs").')
    table, _, files = rest.partition("Case, results")
    rows = [row for row in AVERAGE.findall(table) if row[0] != "time to solution, s"]
    lines = [line.rstrip() for line in (head + files).splitlines()]
    return [ROUND_OFF.sub("…", WALL_TIME.sub("…", line)) for line in lines], rows
