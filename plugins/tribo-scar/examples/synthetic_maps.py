"""Height maps of a ball before and after a run, so that the lost volume is known.

The second map is shifted, turned and tilted, and lacks some pixels; both have 20 nm of noise.
Writes ``before.npy`` and ``after.npy``, in m::

    python examples/synthetic_maps.py
"""

import numpy as np
from scipy.ndimage import map_coordinates
from tribo import Archard, Body, Case, Flat, Grid, Material, Reciprocating, Rough, Sphere

N = 96

steel = Material(young="207 GPa", poisson=0.3)
archard = Archard(k=3.11e-16)
stroke = Reciprocating(stroke="8 mm", frequency=6.25, duration="600 s", positions="average")
case = Case(
    grid=Grid("1.5 mm", N),
    load="100 N",
    bodies={
        "ball": Body(surface=Sphere(radius="5 mm"), material=steel, wear=archard),
        "disk": Body(surface=Flat(), material=steel, wear=archard),
    },
    contact="winkler",
    kinematics=stroke,
)
with case.run() as result:
    ball = result.body("ball")
    maps = [ball.height, ball.surface(-1)]
    lost = result.saves()[-1]["bodies"]["ball"]["wear_volume_m3"]
print(f"The run removed {1e9 * lost:.4g} mm³ from the ball.")

# Relief of 0.1 µm, which the unworn rim of both maps has.
relief = Rough(sq="0.1 um", cut_off="80 um", roll_off="0.3 mm").height(case.grid)
before, after = (heights + relief for heights in maps)

x, y = np.indices((N, N)) - 0.5 * (N - 1)
c, s = np.cos(0.01), np.sin(0.01)
moved = np.stack([c * x - s * y + 3.4, s * x + c * y - 2.2]) + 0.5 * (N - 1)
after = map_coordinates(after, moved, order=5, mode="nearest") + 1e-8 * x - 2e-8 * y

random = np.random.default_rng(1)
for name, heights in (("before.npy", before), ("after.npy", after)):
    noisy = heights + 20e-9 * random.normal(size=heights.shape)
    noisy[random.random(heights.shape) < 0.01] = np.nan
    np.save(name, noisy)
