"""Folders that may not be written to, or not entered."""

import os
import shutil
import sys
from contextlib import chdir
from importlib import import_module
from pathlib import Path
from pkgutil import walk_packages
from tempfile import mkdtemp

import pytest
import sweeps
from click.testing import CliRunner
from made_results import quick_reports

import tribo as package
from tribo import load_case, sweep
from tribo.cli.main import tribo
from tribo.core.errors import CaseError, OutputError
from tribo.templates import template

pytestmark = pytest.mark.slow
NOBODY = 65534
CODE = package.__file__
QUICK = ["--set", "grid.cells=24", "--set", "grid.size=0.7 mm", "--set", "kinematics.duration=20"]
QUICK += ["--set", "output.save_times=[0]"]


@pytest.fixture(scope="module")
def given():
    """A case and two results in a folder that, unlike those of pytest, all may read and enter."""
    folder = Path(mkdtemp())
    (folder / "my.toml").write_text(template("ball_on_disk"), encoding="utf-8")
    # With all that is imported on the way: nobody may not read where Python is.
    for command in ("run my.toml -o a.h5", "compare a.h5 b.h5", "plot a.h5"):
        with chdir(folder), pytest.MonkeyPatch.context() as monkeypatch:
            quick_reports(monkeypatch)
            done = CliRunner().invoke(tribo, command.split() + QUICK * command.startswith("run"))
            assert done.exit_code == 0, done.output
        shutil.copy(folder / "a.h5", folder / "b.h5")
    shutil.copy(sweeps.case(folder / "small"), folder / "small.toml")
    for name, mode in {"denied": 0o555, "entry": 0, "swept": 0o777, "swept/results": 0}.items():
        (folder / name).mkdir()
        (folder / name).chmod(mode)
    folder.chmod(0o755)
    yield folder
    shutil.rmtree(folder)


@pytest.fixture
def nobody():
    """Whoever runs the tests: root may write anywhere."""
    if os.geteuid() == 0:
        # Python itself may be where only root can import from.
        for module in walk_packages(package.__path__, "tribo."):
            if not module.name.endswith("__main__"):
                import_module(module.name)
        os.seteuid(NOBODY)
        # A run reads the code that it is made by, and what is installed.
        readable = all(os.access(p, os.R_OK, effective_ids=True) for p in (CODE, sys.prefix))
        if readable:
            yield
        os.seteuid(0)
        if not readable:
            pytest.skip("only root may read where tribo or its environment is")
    else:
        yield


@pytest.mark.parametrize(
    "command",
    [
        "new ball_on_disk denied/my.toml",
        "demo -d denied/demo",
        "plugins new acme-fretting --kind wear-law -d denied",
        "run my.toml -o denied/my.h5",
        "plot a.h5 -d denied/plots",
        "export a.h5 -d denied/csv",
        "compare a.h5 b.h5 -o denied/compare",
        "compare my.toml --vary load.normal=1,2 -o denied/compare",
        "compare my.toml --vary load.normal=1,2 -o entry",
    ],
)
def test_it_is_one_message_and_exit_code_3(given, nobody, monkeypatch, command):
    monkeypatch.chdir(given)
    done = CliRunner().invoke(tribo, command.split() + QUICK * ("my.toml --vary" in command))
    assert isinstance(done.exception, OutputError), done.output
    assert done.exception.exit_code == 3
    message = str(done.exception)
    assert "cannot " in message
    assert command.split()[-1].split("/")[0] in message
    assert "Permission denied" in message
    for word in ("space", ".new", "Errno"):
        assert word not in message


def test_what_lies_in_a_folder_that_cannot_be_entered_is_one_message(given, nobody, monkeypatch):
    monkeypatch.chdir(given)
    with pytest.raises(CaseError, match=r"^entry/my\.toml cannot be read: Permission denied$"):
        load_case("entry/my.toml")
    with pytest.raises(OutputError, match=r"^cannot write to swept: Permission denied$"):
        sweep("small.toml", sweeps.LOADS, "swept", executor=sweeps.Inline())
