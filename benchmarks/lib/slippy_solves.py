"""Solve contacts with slippy, under the Python 3.9 that it needs.

`benchmarks.lib.peers.Slippy` starts this file. A request is a line of JSON, a gap and a first
pressure in float64, for E* = 1 and a window of unit edge; a reply is a line of JSON with the CPU
time in s and the iterations, and the pressure. Kernels and plans are made before the clock starts.
"""

from __future__ import annotations

import json
import sys
import time
from functools import lru_cache

import numpy as np


@lru_cache(maxsize=1)
def _convolution(cells, periodic):
    from slippy.core import (
        elastic_influence_matrix_frequency,
        elastic_influence_matrix_spatial,
        get_angular_velocity,
        plan_convolve,
    )

    spacing = [1 / cells] * 2
    if periodic:
        x, y = get_angular_velocity([cells] * 2, spacing)
        square = x**2 + y**2
        kernel = elastic_influence_matrix_frequency(y, x, np.sqrt(square), square, "zz", 1.0, 0.0)
    else:
        kernel = elastic_influence_matrix_spatial("zz", [2 * cells] * 2, spacing, 0.5, 0.0)
    return plan_convolve(np.zeros((cells, cells)), kernel, None, periodic, fft_im=periodic)


def main():
    """Answer until the input ends."""
    import slippy
    from slippy.core import polonsky_and_keer

    slippy.CORES = 1
    source, answers = sys.stdin.buffer, sys.stdout.buffer
    sys.stdout = sys.stderr
    for line in source:
        request = json.loads(line)
        cells = request["cells"]
        gap, guess = (
            np.frombuffer(source.read(8 * cells**2)).reshape(cells, cells) for _ in range(2)
        )
        convolve = _convolution(cells, request["periodic"])
        calls = 0

        def counted(pressure, convolve=convolve):
            nonlocal calls
            calls += 1
            return convolve(pressure)

        begun = time.process_time()
        _, pressure, _ = polonsky_and_keer(
            counted, guess, gap, request["mean"], 1 / cells, request["tolerance"], request["most"]
        )
        spent = time.process_time() - begun
        # An iteration convolves the pressure and the direction.
        reply = {"seconds": spent, "iterations": calls // 2}
        answers.write(json.dumps(reply).encode() + b"\n" + pressure.tobytes())
        answers.flush()


if __name__ == "__main__":
    main()
