"""A path in the plane, whose positions lie beside one another along x and across."""

import numpy as np
import pytest

from tribo import Case, CaseError, Grid, Simulation

GRID = Grid((0.9e-3, 1.6e-3), (36, 64))
STEEL = {"young": "210 GPa", "poisson": 0.3, "hardness": "40 GPa"}
BALL = {"type": "sphere", "radius": "20 mm"}
SPRINGS, K, LOAD, TURNS = 2e14, 16e-14, 20.0, 25


def case(surface=BALL, positions=49, **motion):
    law = {"type": "archard", "k": K}
    given = {"path": "circle", "extent": ("0.4 mm", "0.4 mm"), "speed": "20 mm/s"}
    return Case(
        grid=GRID,
        load={"normal": LOAD},
        bodies={
            "pin": {"surface": surface, "material": STEEL, "wear": law},
            "plate": {"surface": {"type": "flat"}, "material": STEEL, "wear": law},
        },
        contact={"type": "winkler", "modulus": SPRINGS, "plasticity": False},
        stepping={"type": "implicit", "depth_tolerance": 1e-3},
        kinematics={"type": "planar", "revolutions": TURNS, "positions": positions}
        | given
        | motion,
    )


TWO_TO_ONE = [(0, 0), (4e-4, 0), (4e-4, 2e-4), (0, 2e-4)]


@pytest.mark.parametrize("path", ["circle", "square", "eight", TWO_TO_ONE])
def test_the_body_goes_where_it_heads(path):
    extent = (4e-4, 3e-4) if isinstance(path, str) else None
    model = Simulation(case(path=path, extent=extent, positions=48)).model
    extent = model.motion.component.track_extent
    assert model.cycle.maps["plate"].track(GRID) == pytest.approx(extent, rel=1e-12, abs=0)
    np.testing.assert_allclose(model.cycle.fields[0]["place_x"]["pin"][:, 0], GRID.x)
    # The window moves over the body against the body itself.
    steps = -np.diff(model.cycle.offsets, axis=0)
    ways = np.array([position.heading for position in model.cycle])
    between = ways[1:] + ways[:-1]
    ahead = np.sum(steps * between, axis=1)
    # A position may lie in the cell of the one before.
    assert np.all(ahead >= 0)
    assert np.mean(ahead > 0) > 0.8
    fields = [model.cycle.fields[position] for position in range(len(model.cycle))]
    for way, of_motion in zip(ways, fields, strict=True):
        for name, part in zip(("heading_x", "heading_y"), way, strict=True):
            # The plate goes; what slides over it comes the other way.
            np.testing.assert_allclose(of_motion[name]["pin"], part)
            np.testing.assert_allclose(of_motion[name]["plate"], -part)
    places = np.array([[f[n]["plate"][0, 0] for n in ("place_x", "place_y")] for f in fields])
    np.testing.assert_allclose(np.diff(places[:3], axis=0), -steps[:2] * GRID.spacing, atol=1e-12)


@pytest.mark.parametrize("path", [[(4e-4, 0), (0, 0)], [(0, 0), (0, 3e-4), (-3e-4, 0)], "square"])
def test_the_middle_position_may_lie_at_an_end_of_the_path(path):
    extent = (4e-4, 4e-4) if path == "square" else None
    model = Simulation(case(path=path, extent=extent, positions=8)).model
    plate = model.cycle.maps["plate"]
    field = np.arange(plate.rows * 64.0).reshape(plate.rows, 64)
    for position in range(len(model.cycle)):
        assert plate.see(field, position).shape == GRID.cells
        row, column = plate.first_cell(position)
        assert plate.see(field, position)[0, 0] == field[row, column % 64]


def test_what_cannot_be_is_refused():
    with pytest.raises(ValueError, match="give extent with a path from a formula"):
        case(extent=None)
    with pytest.raises(CaseError, match="the path and the contact have to fit into it along y"):
        Simulation(case(extent=(1e-4, 1.5e-3), positions="cells")).run()
