"""A flat pin that begins worn by a run under another load."""

import tempfile
from pathlib import Path

import tribo

STEEL = tribo.Material(young="207 GPa", poisson=0.3)


def found(part: float) -> dict[str, float]:
    """Return the depth (m), load times distance (N m) and work of friction (J) of two runs."""
    parts = {
        "grid": tribo.Grid("0.1 mm", 4),
        "bodies": {
            "pin": tribo.Body(surface="flat", material=STEEL, wear=tribo.Archard(k=3.11e-16)),
            "flat": tribo.Body(surface="flat", material=STEEL),
        },
        "contact": tribo.Periodic(),
        "friction": 0.1,
    }
    with tempfile.TemporaryDirectory() as folder:
        file, begin = Path(folder) / "first.h5", None
        for load, distance in ((4.0, 2.0), (6.0, 1.0)):
            motion = tribo.Unidirectional(speed=0.1, track_length=1e-4, distance=distance)
            case = tribo.Case(load=load, kinematics=motion, begin=begin, **parts)
            with case.run(file if begin is None else None) as result:
                last = result.saves()[-1]
            begin = file
    return {
        "wear depth": last["bodies"]["pin"]["max_wear_depth_m"],
        "load times distance": last["load_distance_N_m"],
        "friction work": last["friction_energy_J"],
    }
