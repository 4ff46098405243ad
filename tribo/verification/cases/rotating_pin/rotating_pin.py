"""A round flat pin on a turning disk: what its points slide of a straight track."""

import numpy as np

import tribo

K, LOAD = 3e-16, 100.0
GRID = tribo.Grid(1.1e-3, 48)
STEEL = tribo.Material(young="207 GPa", poisson=0.3)
SPRINGS, HALF_SPACE = tribo.Winkler(modulus=1.2973e15), tribo.DcFft()
CASES = {"even": (SPRINGS, 1e-4), "punch": (HALF_SPACE, 1e-4), "worn": (SPRINGS, 1e6)}
"""Contact and revolutions, after which the pressure is still the first one, or wears evenly."""


def found(part: float) -> dict[str, float]:
    """Return the worn volume over k F s, less 1, by pressure and radius of the track."""
    inside = np.hypot(*GRID.mesh) < 0.5e-3
    disc = tribo.HeightMap(size=GRID.size, heights=np.where(inside, 0.0, -1e-3))
    radius = np.sqrt(np.count_nonzero(inside) * GRID.cell_area / np.pi)
    volumes = {}
    for pressure, (contact, revolutions) in CASES.items():
        for radii in (1.25, 2.5, 5):
            motion = tribo.Rotating(speed=0.1, track_radius=radii * radius, revolutions=revolutions)
            bodies = {
                "pin": tribo.Body(surface=disc, material=STEEL, wear=tribo.Archard(k=K)),
                "disk": tribo.Body(surface=tribo.Flat(), material=STEEL),
            }
            case = tribo.Case(
                grid=GRID, load=LOAD, bodies=bodies, contact=contact, kinematics=motion
            )
            with tribo.Simulation(case).run() as result:
                worn = result.saves()[-1]["bodies"]["pin"]["wear_volume_m3"]
                volumes[f"{pressure}, R/a = {radii:g}"] = (
                    worn / (K * LOAD * float(result.distances[-1])) - 1
                )
    return volumes
