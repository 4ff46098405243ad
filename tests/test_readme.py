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
RESOLVED = re.compile(r"(?<=\d) +[\d.]+$|(?<=groove )\d+(?= % too deep: docs)")
QUICK = (
    "kinematics.positions=33",
    "grid.cells=16",
    "stepping.depth_tolerance=0.02",
    "stepping.pressure_tolerance=0.5",
    "stepping.settle=0.1",
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
    # The resolved hour in a few seconds: its own column is masked.
    monkeypatch.setattr("tribo.cli.demo.RESOLVED", QUICK)
    printed = CliRunner().invoke(tribo, ["demo"], catch_exceptions=False)
    assert printed.exit_code == 0
    (shown,) = SHOWN
    assert _comparable(shown) == _comparable(printed.stdout)


def test_its_resolved_hour_is_that_of_the_page_on_the_paper():
    page = (ROOT / "docs" / "paper.md").read_text(encoding="utf-8")
    for here, there in (
        ("groove, largest depth, µm", "groove at mid-stroke, µm"),
        ("groove where sliding turns, µm", "groove where the contact turns round, µm"),
        ("ball, largest depth, µm", "ball depth, µm"),
        ("contact along, mm", "contact along at mid-stroke, mm"),
        ("pressure at the centre, MPa", "centre pressure, MPa"),
    ):
        average, resolved = re.search(rf"{here} +(\S+) +(\S+)$", README, re.M).groups()
        known = re.search(rf"\| {there} \| (\S+) \| (\S+) \|", page).groups()
        assert (float(average), float(resolved)) == pytest.approx(
            [float(value) for value in known], rel=6e-3
        )


def test_its_pictures_are_small():
    pictures = re.findall(r"\]\((docs/images/[^)]+)\)", README)
    assert pictures
    for picture in pictures:
        assert 0 < (ROOT / picture).stat().st_size < 150_000


def _comparable(text):
    """Lines without what differs from run to run: wall time, round-off, trailing space."""
    lines = [line.rstrip() for line in text.strip().splitlines()]
    resolved = lines.index("After 360 m")
    lines[resolved + 1 :] = [RESOLVED.sub("…", line) for line in lines[resolved + 1 :]]
    return [ROUND_OFF.sub("…", WALL_TIME.sub("… s.", line)) for line in lines]
