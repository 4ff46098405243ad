"""Nothing needs the modules that Windows lacks, nor psutil."""

import os
import subprocess
import sys

import pytest

# The workers of a sweep begin with this too.
BLOCK = """
import sys
sys.modules["fcntl"] = sys.modules["resource"] = sys.modules["psutil"] = None
"""
SCRIPT = """
import sys
from pathlib import Path
from tribo import Interrupted, Simulation, load_case
from tribo.observers.observer import Observer
from tribo import sweep
from tribo.templates import template


class StopAt(Observer):
    def on_step(self, snapshot):
        if snapshot.state.steps == 5:
            raise KeyboardInterrupt


if __name__ == "__main__":
    assert sys.modules["fcntl"] is sys.modules["psutil"] is None
    Path("case.toml").write_text(template("ball_on_disk"), encoding="utf-8")
    short = ["kinematics.duration=4", "output.save_times=[2]", "grid={size=7e-4, cells=16}"]
    case = load_case("case.toml", overrides=short)
    whole = Simulation(case).run("whole.h5")
    try:
        Simulation(case).run("stopped.h5", observers=[StopAt()])
    except Interrupted:
        resumed = Simulation(case).resume("stopped.h5")
    assert resumed.field("pressure", -1).tobytes() == whole.field("pressure", -1).tobytes()
    swept = sweep(case, {"load.normal": [50, 100]}, "out", jobs=1)
    assert list(swept.table["status"]) == ["done", "done"]
    print("run, resumed, swept")
"""


@pytest.mark.slow
def test_a_case_a_resume_and_a_sweep_run_without_fcntl_resource_and_psutil(tmp_path):
    for name, text in (("sitecustomize", BLOCK), ("runs", SCRIPT)):
        (tmp_path / f"{name}.py").write_text(text, encoding="utf-8")
    ended = subprocess.run(
        [sys.executable, "runs.py"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(tmp_path), "PYTHONWARNINGS": "ignore"},
        capture_output=True,
        text=True,
        timeout=100,
        check=False,
    )
    assert (ended.stdout, ended.returncode) == ("run, resumed, swept\n", 0), ended.stderr
