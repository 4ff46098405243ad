"""Warnings point to the line of the user that led to them."""

import warnings

import tribo
from tribo import GPa, N, mm

STEEL = tribo.Material(young=210 * GPa, poisson=0.3)
COARSE = tribo.Case(
    grid=tribo.Grid(size=1 * mm, cells=16),
    load=20 * N,
    bodies={
        "ball": tribo.Body(
            surface=tribo.Sphere(radius=5 * mm), material=STEEL, wear=tribo.Archard(k=1e-15)
        ),
        "plate": tribo.Body(surface=tribo.Flat(), material=STEEL),
    },
    kinematics=tribo.Unidirectional(speed=0.1, distance=1.0, track_radius=0.01, swept="plate"),
)


def test_a_run_warns_at_the_line_that_runs_it():
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        COARSE.run()
        tribo.Simulation(COARSE).run()
        tribo.compare([COARSE, COARSE])
    assert len(caught) >= 3
    assert {each.filename for each in caught} == {__file__}
    assert len({each.lineno for each in caught}) == 3
