"""A flat pin that begins worn by a run under another load."""

import tempfile
from pathlib import Path

import tribo

STEEL = tribo.Material(young="207 GPa", poisson=0.3)
BODIES = {
    "pin": tribo.Body(surface=tribo.Flat(), material=STEEL, wear=tribo.Archard(k=3.11e-16)),
    "flat": tribo.Body(surface=tribo.Flat(), material=STEEL),
}


def case(load: float, distance: float, begin: str | None = None) -> tribo.Case:
    """Return a case under a load (N) over a distance (m), with the worn bodies of a file."""
    return tribo.Case(
        grid=tribo.Grid("0.1 mm", 4),
        load=load,
        bodies=BODIES,
        contact=tribo.Periodic(),
        friction=0.1,
        kinematics=tribo.Unidirectional(speed=0.1, track_length=1e-4, distance=distance),
        begin=begin,
    )


def found(part: float) -> dict[str, float]:
    """Return the depth (m), load times distance (N m) and work of friction (J) of two runs."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "first.h5"
        case(4, 2).run(file).close()
        with case(6, 1, str(file)).run() as result:
            last = result.saves()[-1]
    return {
        "wear depth": last["bodies"]["pin"]["max_wear_depth_m"],
        "load times distance": last["load_distance_N_m"],
        "friction work": last["friction_energy_J"],
    }
