"""What falls to the positions of a stroke: path, speeds and rests, and the speeds of a sine."""

import numpy as np

import tribo
from tribo.motion.stroke import Stroke


def found() -> dict[str, float]:
    """Return weights in parts of 1, speeds in m/s and times in s for each metre."""
    shares = Stroke(length=2.5, dx=1.0).shares
    # At 1.5 m/s to within the second cell, at 0.5 m/s to the end, a rest of 1 s, and back at 1 m/s.
    times, places = np.array([0.0, 1.0, 2.0, 3.0, 5.0]), np.array([-1.0, 0.5, 1.0, 1.0, -1.0])
    end = Stroke(length=2.0, dx=1.0).passed(times, places)[-1]
    motion = tribo.Reciprocating(stroke=2e-3, frequency=25, cycles=1, waveform="sinusoidal")
    sine = motion.cycle(tribo.Grid("1 mm", 4))[0].speeds
    assert end.speeds is not None
    assert sine is not None
    return {
        "weight beyond the end of a stroke": shares[-1],
        "weight before the end of a stroke": shares[-2],
        "mean speed at the end": sum(share * v for v, share in end.speeds),
        "time for each metre at the end": sum(share / v for v, share in end.speeds),
        "rest for each metre at the end": end.rest,
        "sine: mean speed over the path": sum(share * v for v, share in sine),
        "sine: time for each metre": sum(share / v for v, share in sine),
    }
