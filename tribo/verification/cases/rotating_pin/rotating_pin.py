"""A round flat pin on a turning disk: what its points slide of a straight track."""

import tribo
from tribo.verification.cases.pins import disc, pin_on_flat

K, LOAD = 3e-16, 100.0
GRID = tribo.Grid(1.1e-3, 48)
SPRINGS, HALF_SPACE = tribo.Winkler(modulus=1.2973e15), tribo.DcFft()
CASES = {"even": (SPRINGS, 1e-4), "punch": (HALF_SPACE, 1e-4), "worn": (SPRINGS, 1e6)}
"""Contact and revolutions, after which the pressure is still the first one, or wears evenly."""


def found() -> dict[str, float]:
    """Return the worn volume over k F s, less 1, by pressure and radius of the track."""
    (pin, radius), law, volumes = disc(GRID, 0.5e-3), tribo.Archard(k=K), {}
    for pressure, (contact, revolutions) in CASES.items():
        for radii in (1.25, 2.5, 5):
            motion = tribo.Rotating(speed=0.1, track_radius=radii * radius, revolutions=revolutions)
            case = pin_on_flat(pin, law, grid=GRID, load=LOAD, contact=contact, kinematics=motion)
            with case.run() as result:
                worn = float(result.wear_volume[-1, 0] / (K * LOAD * result.distances[-1]))
            volumes[f"{pressure}, R/a = {radii:g}"] = worn - 1
    return volumes
