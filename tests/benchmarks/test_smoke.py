"""The benchmarks run; what they measure is not judged here."""

import json
import subprocess
import sys
from pathlib import Path

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


def test_the_cost_of_the_plugin_layer_is_measured():
    command = [sys.executable, BENCHMARKS / "plugin_cost.py", "--cells", "32", "--repeats", "2"]
    done = subprocess.run([*command, "--json"], capture_output=True, text=True, check=True)
    found = json.loads(done.stdout)
    assert found["cells"] == 32
    assert 0 < found["ratio_min"] <= found["ratio_median"] <= found["ratio_max"]
    assert found["making_added_ratio"] * found["making_added_s"] >= 0
