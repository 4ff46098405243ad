"""A Python file beside a case takes part where the command line names it, and nowhere else."""

from pathlib import Path

import pytest
from fake_distributions import SHORT

from tribo import Result
from tribo.core.errors import CaseError
from tribo.registry.plugin_file import add_files
from tribo.registry.registry import default_registry
from tribo.templates import template

LAW = """
import numpy as np
from tribo import Column, WearLaw, WearRate, hookimpl

class Plain(WearLaw):
    k: float = 3e-16

    def rate(self, local):
        STOP
        return WearRate(self.k * local.pressure, np.full_like(local.pressure, self.k))

@hookimpl
def tribo_quantities():
    return [Column("answer", "m", "answer", lambda result: 42.0)]
"""
OWN_LAW = Path(__file__).parents[2] / "examples" / "own_law.py"
STOP = "CALLS.append(1)\n        if len(CALLS) > 5: raise KeyboardInterrupt\n"


@pytest.fixture(autouse=True)
def case(folder):
    """A case that names a law, and the file of that."""
    case = template("ball_on_disk").replace('{ type = "archard", k = "3.11e-16 1/Pa" }', '"plain"')
    (folder / "my.toml").write_text(case)
    (folder / "law.py").write_text(LAW.replace("STOP", ""))


def test_a_law_of_a_file_runs_where_the_command_names_it_and_the_result_names_the_file(
    asked, folder
):
    refused = asked("run", "my.toml", *SHORT)
    assert refused.returncode == 2
    assert "plain" in refused.stderr
    done = asked("run", "my.toml", "--plugin", "law.py", *SHORT)
    assert done.returncode == 0, done.stderr
    assert "answer: 42 m" in done.stdout
    with Result.open(folder / "my.h5") as result:
        made = result.provenance
    (plugin,) = [each for each in made["plugins"] if each["origin"] == "file"]
    code = made["components"]["bodies.ball.wear"]["code"]
    assert (plugin["distribution"], plugin["version"]) == ("law.py", code[:12])
    assert not (folder / "__pycache__").exists()


@pytest.mark.slow
@pytest.mark.parametrize(("factor", "code"), [("", 0), ("-", 3)])
def test_a_file_is_checked_by_its_path(asked, folder, factor, code):
    law = OWN_LAW.read_text().replace("WearRate(self", f"WearRate({factor}self")
    (folder / "law.py").write_text(law)
    done = asked("plugins", "check", "law.py")
    assert done.returncode == code, done.stdout
    assert done.stdout.startswith("wear law Threshold (threshold): ")


@pytest.mark.slow
def test_resume_needs_the_same_file_again_unless_another_is_allowed(asked, folder):
    (folder / "law.py").write_text(f"CALLS = []\n{LAW}".replace("STOP", STOP))
    stopped = asked("run", "my.toml", "--plugin", "law.py", *SHORT)
    assert stopped.returncode == 130
    assert "tribo resume my.h5 --plugin law.py" in stopped.stderr
    without = asked("resume", "my.h5")
    assert without.returncode == 2
    assert "--plugin law.py" in without.stderr
    # Another version may have another key.
    newer = LAW.replace("STOP", "").replace("= 3e-16\n", "= 3e-16\n    extra: float = 1.0\n")
    (folder / "law.py").write_text(newer)
    changed = asked("resume", "my.h5", "--plugin", "law.py")
    assert changed.returncode == 2
    assert "bodies.ball.wear was code" in changed.stderr
    allowed = asked("resume", "my.h5", "--plugin", "law.py", "--allow-changed")
    assert allowed.returncode == 0, allowed.stderr
    with Result.open(folder / "my.h5") as result:
        made = result.provenance
    (later,) = made["resumed_with"]
    codes = [each["components"]["bodies.ball.wear"]["code"] for each in (made, later)]
    assert codes[0] != codes[1]


@pytest.mark.slow
def test_the_workers_of_a_sweep_take_a_file_too(asked):
    short = ["kinematics.duration=0.1", "output.save_times=[]", "grid={size=7e-4, cells=32}"]
    options = [part for each in short for part in ("--set", each)]
    options += ["--vary", "load.normal=[50]", "--jobs", "1", "--plugin", "law.py"]
    done = asked("sweep", "my.toml", *options)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (LAW.replace("(self, local):", "(self, local:"), r"--plugin: SyntaxError: .*, line 8\)"),
        (LAW.replace("def rate", "def wear_rate"), r"--plugin .*: .*no method rate;"),
        ("def f():\n    1 / 0\nf()", r"line 2\)"),
        ("raise SystemExit(0)", "SystemExit"),
        (LAW + LAW.replace("Plain(", "Other(").replace("k:", "type = 'plain'\n    k:"), "twice"),
        (None, "no such file"),
    ],
)
def test_a_file_that_cannot_take_part_is_one_clear_error(folder, text, words):
    (folder / "law.py").unlink()
    if text is not None:
        (folder / "law.py").write_text(text.replace("STOP", ""))
    with pytest.raises(CaseError, match=words) as failure:
        add_files([folder / "law.py"])
    assert str(failure.value).count("law.py") == 1
    assert [each for each in default_registry().plugins if each.origin == "file"] == []
