"""The README: its commands and its Python run, and print what it shows."""

import re
import subprocess
import sys
import tomllib
from importlib import import_module
from pathlib import Path

import pytest
from click.testing import CliRunner

from tribo.cli.main import tribo

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\w*)\n(.*?)^```$", README, re.S | re.M)


def _blocks(kind):
    return [text for each, text in BLOCKS if each == kind]


def test_it_gives_the_two_commands():
    assert _blocks("") == [
        "pip install . && tribo demo\n",
        "pip install -r requirements-dev.txt && pytest\n",
    ]


@pytest.mark.parametrize("package", sorted(ROOT.glob("plugins/tribo-*")), ids=lambda p: p.name)
def test_no_link_breaks_where_the_readme_of_a_package_is_shown_alone(package):
    links = re.findall(r"\]\(([^)]*)\)", (package / "README.md").read_text(encoding="utf-8"))
    assert all(link.startswith("https://") for link in links)


def test_it_is_short():
    assert len(README.splitlines()) <= 120


@pytest.mark.slow
def test_its_commands_print_its_table(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "80")
    (commands,), (table,) = _blocks("sh"), _blocks("text")
    for line in commands.splitlines():
        name, *arguments = line.partition("#")[0].split()
        assert name == "tribo"
        printed = CliRunner().invoke(tribo, arguments, catch_exceptions=False)
        assert printed.exit_code == 0
    assert printed.stdout.startswith(table)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:(positions|resolution)")
def test_its_python_runs_and_its_law_serves_in_a_case_file(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    script, law = _blocks("python")
    Path("law.py").write_text(law)
    # The same case averaged: the law is the subject.
    script = script.replace('"10 min"', '"10 min", positions="average"')
    exec(compile(script, "README.md", "exec"), {"__name__": "readme"})
    assert "Wear after 60 m" in capsys.readouterr().out

    (wear,) = re.findall(r"`wear = (\{.*?\})`", README)
    settings = (f"bodies.pin.wear={wear}", "grid.cells=64", "output.save_times=[]")
    run = ["run", "my.toml", "--plugin", "law.py", *(f"--set={each}" for each in settings)]
    for command in (["new", "pin_on_disk", "my.toml"], run):
        # Of its own, as a process takes but one file of a name.
        subprocess.run([sys.executable, "-m", "tribo", *command], check=True, capture_output=True)


def test_its_pictures_are_small():
    pictures = re.findall(r"\]\((docs/images/[^)]+)\)", README)
    assert pictures
    for picture in pictures:
        assert 0 < (ROOT / picture).stat().st_size < 150_000


def test_its_links_lead_somewhere():
    for place in re.findall(r"\]\(([^)#]+)", README):
        assert (ROOT / place).exists(), place


def test_its_links_lead_to_the_repository_on_a_package_index(monkeypatch):
    monkeypatch.syspath_prepend(ROOT)
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    import_module("hatch_build").ReadmeLinks(str(ROOT), {}).update(project)
    links = re.findall(r"\]\(([^)#]+)", project["readme"]["text"])
    assert len(links) == len(re.findall(r"\]\(", README))
    for link in links:
        place = re.sub(rf"^{project['urls']['Repository']}/(raw|blob)/main/", "", link)
        assert place != link
        assert (ROOT / place).exists()
