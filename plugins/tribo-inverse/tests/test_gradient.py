"""The gradient of a run is that of the same steps taken with other inputs."""

import numpy as np
import pytest
from gradients import (
    BASE,
    CLOSE,
    FRESH,
    HARD,
    LONG,
    MIDDLE,
    ODD,
    OF_FRESH,
    OF_SMOOTH,
    RAMP,
    SHAPE,
    SMALL,
    SMOOTH,
    STAGES,
    Kind,
    end_distance,
    few,
    kind,
    resolved,
    run,
)
from paper_models import K, archard, flat, motion, named, pair, power, steel
from tribo.case import Layer, Stop
from tribo.contact.periodic import Periodic
from tribo.contact.winkler import Winkler
from tribo.core.grid import Grid
from tribo.motion.closed_track import Rotating, Unidirectional
from tribo.motion.planar import Planar
from tribo.stepping.explicit import Explicit
from tribo.stepping.implicit import Implicit
from tribo.surfaces.forms import Cylinder
from tribo.surfaces.relief import Waves
from tribo.surfaces.surface import Surface
from tribo.wear.archard import Archard
from tribo.wear.modified import times

from tribo_inverse.adjoint.gradient import gradient
from tribo_inverse.adjoint.objective import Deepest, Depth, EndTime, Pressure, Volume


def flats():
    waves = Waves(wavelength="32 um", amplitude="0.2 um")
    slides = motion(stroke="64 um", duration=None, distance=5.0, positions=5)
    return run(
        grid=Grid(("64 um", "64 um"), (16, 16)),
        load=1.0,
        contact=Periodic(tolerance=1e-12),
        stepping=Implicit(cycle_tolerance=1e-5),
        kinematics=slides,
        bodies=[
            named("ball", waves, steel(), archard()),
            named("disk", flat(), steel(), archard()),
        ],
    )


LINE = [named("ball", Cylinder(radius="5 mm"), steel(), archard()), named("disk", flat(), steel())]
YIELDING = pair(archard(), archard(), ("1.2 GPa", "1.1 GPa"))
SOFT = pair(archard(), archard(), ("1.1 GPa", "1 GPa"))


def coated(hardness=(None, None)):
    """The disk in a stiffer layer."""
    ball, (name, disk) = pair(archard(), archard(), hardness)
    layer = Layer(
        thickness="30 um", wear=archard(2 * K), young="400 GPa", poisson=0.25, hardness=hardness[1]
    )
    return [ball, (name, disk.model_copy(update={"layers": (layer,)}))]


OF_COATING = [f"bodies.disk.layers.1.{key}" for key in ("thickness", "young", "poisson")]
OF_COATING += ["bodies.disk.material.young", "bodies.ball.material.poisson"]


class Brisk(Archard):
    type = "brisk"

    def rate(self, local):
        return times(np.sqrt(1e9 * local.speed / local.material.hardness), super().rate(local))


CIRCLE = {"path": "circle", "extent": (1e-4, 1e-4), "speed": 0.02, "revolutions": 9000}
KINDS = {
    "average": kind(Deepest("disk"), [*BASE, *SHAPE, "kinematics.stroke"], 1e-4),
    "pressure": kind(Pressure(2e-5, 0), [*BASE, *SHAPE], 1e-4),
    "springs": kind(
        Depth("ball"),
        [*BASE, *SHAPE, HARD],
        contact=Winkler(plasticity=False),
        bodies=pair(archard(), Brisk(k=K), ("2 GPa", "1 GPa")),
    ),
    "nonlinear": kind(
        Depth("disk"),
        [*BASE, *SHAPE, "bodies.ball.wear.p_exponent"],
        1e-6,
        bodies=pair(power(1.5), power(2.0)),
        stepping=few(nonlinear_tolerance=1e-13),
    ),
    "yields": kind(Depth("disk"), [*BASE, *SHAPE, HARD], 1e-6, grid=ODD, bodies=YIELDING),
    "positions, yields, elastic layer": kind(
        Depth("disk", 5e-5),
        ["load.normal", *OF_COATING],
        3e-5,
        grid=ODD,
        kinematics=resolved(duration=10),
        bodies=coated(("1.1 GPa", "1 GPa")),
        stepping=few(cycle_tolerance=1e-12),
    ),
    "load over time": kind(
        {10.0: Depth("disk")},
        [*STAGES, *OF_FRESH, BASE[2], "load.normal.2.at", "load.normal.3.until"],
        grid=SMALL,
        load=RAMP,
        bodies=pair(FRESH, power(1.5)),
        kinematics=motion(duration=10),
        stepping=LONG,
    ),
    "explicit": kind(
        Depth("disk"),
        [*BASE[:1], *BASE[2:], *SHAPE, *OF_FRESH],
        bodies=pair(FRESH, power(1.5)),
        stepping=Explicit(time_step=3),
    ),
    "repeating": Kind(
        flats(), Depth("ball"), ["load.normal", "bodies.ball.surface.amplitude"], 1e-5
    ),
    "rows of their own speed": kind(
        Depth("disk"),
        ["load.normal", "kinematics.speed", "kinematics.track_radius"],
        kinematics=Rotating(track_radius="1.5 mm", speed=0.1, duration=20.0),
        bodies=pair(power(1.5), archard()),
        stepping=few(nonlinear_tolerance=1e-13),
    ),
    "line": kind(
        Volume("ball"), ["bodies.ball.wear.k"], bodies=LINE, ends_at_window=True, load=10.0
    ),
    "ends at a depth, load over time": kind(
        EndTime(),
        [*STAGES[:2], *OF_FRESH, "load.normal.2.at", "kinematics.frequency", "stop.depth"],
        grid=MIDDLE,
        stop=Stop(depth="0.15 um"),
        load=RAMP,
        bodies=pair(FRESH, power(1.5)),
        kinematics=motion(duration=10),
        stepping=LONG,
    ),
    "ends at a depth of one body": kind(
        {2.0: Deepest("disk"), 20.0: EndTime()},
        ["load.normal", *OF_SMOOTH, "kinematics.stroke"],
        grid=MIDDLE,
        stop=Stop(depth="0.03 um", body="disk"),
        bodies=pair(FRESH, SMOOTH),
        stepping=LONG,
        save_times=(2.0,),
    ),
    "around a circle": kind(
        Depth("disk", x=1e-4),
        [*SHAPE, "load.normal", "kinematics.speed"],
        grid=MIDDLE,
        kinematics=Planar(**CIRCLE, positions="cells"),
        stepping=few(cycle_tolerance=1e-12),
    ),
    "ends at a depth, positions, yields": kind(
        end_distance,
        [*BASE, HARD],
        1e-6,
        grid=MIDDLE,
        stop=Stop(depth="0.05 um"),
        kinematics=resolved(),
        bodies=SOFT,
        stepping=few(cycle_tolerance=1e-12),
    ),
    "ends at a depth, within a stroke": kind(
        end_distance,
        ["load.normal", "kinematics.frequency"],
        grid=MIDDLE,
        stop=Stop(depth="0.2 um"),
        kinematics=resolved(frequency=1, waveform="sinusoidal"),
        bodies=pair(archard(300 * K), archard()),
        stepping=few(cycle_tolerance=1e-12),
    ),
}


@pytest.mark.parametrize("kind", KINDS)
def test_it_is_that_of_the_same_steps(kind):
    assert KINDS[kind].off() < CLOSE


def test_the_objective_may_follow_an_input_itself():
    # The volume of a track is its cross-section times the stroke.
    found = gradient(run(), Volume("disk"), ["kinematics.stroke", "load.normal"])
    assert found.relative["kinematics.stroke"] == pytest.approx(1, rel=1e-8)
    assert found.relative["load.normal"] == pytest.approx(1, rel=1e-8)


@pytest.mark.parametrize("bound", [1.0, 10.0])
def test_a_number_at_its_bound_has_the_derivative_of_one_side(bound):
    # Of a flat pin V = k s F (p/p0)^(m - 1), where m is 1 to 10.
    bodies = [named("ball", flat(), steel(), power(bound)), named("disk", flat(), steel())]
    flats = run(bodies=bodies, contact=Winkler(modulus=1e15), ends_at_window=True)
    exponent = "bodies.ball.wear.p_exponent"
    found = gradient(flats, Volume("ball"), [exponent]).relative[exponent]
    pressure = 20.0 / (0.5e-3) ** 2
    assert found == pytest.approx(bound * np.log(pressure / 1e9), rel=1e-5)


class Step(Surface):
    """A flat of which one half stands 1 µm higher."""

    type = "step"

    def height(self, grid):
        higher = np.arange(grid.cells[0]) < grid.cells[0] // 2
        return np.outer(1e-6 * higher, np.ones(grid.cells[1]))


@pytest.mark.parametrize(
    ("hardness", "load", "x", "lower", "higher"),
    [
        # The lower half just touches: counted as open.
        (None, 0.5, -1e-4, 1.0, 0.5),
        # The higher half just yields, at 8 and 4 MPa: counted as yielding.
        ("8 MPa", 1.5, 1e-4, 1.5, 3.0),
    ],
)
@pytest.mark.parametrize("rounding", [-1e-13, 0, 1e-13])
def test_at_a_change_of_state_the_side_is_the_one_that_is_named(
    hardness, load, x, lower, higher, rounding
):
    bodies = [named("ball", Step(), steel(hardness), archard()), named("disk", flat(), steel())]
    area, springs = 0.5e-3**2, 4e12

    def asked(part):
        return run(
            load=load * springs * 1e-6 * area * (1 + rounding + part),
            bodies=bodies,
            contact=Winkler(modulus=springs),
            ends_at_window=True,
        )

    def relative(part):
        found = gradient(asked(part), {0.0: Pressure(x, 0)}, ["load.normal"])
        return found.relative["load.normal"]

    assert relative(-1e-6) == pytest.approx(lower, rel=1e-5)
    assert relative(1e-6) == pytest.approx(higher, rel=1e-5)
    assert relative(0) == pytest.approx(higher if hardness else lower, rel=1e-5)


@pytest.mark.parametrize(
    ("slides", "path", "expected"),
    [
        # V = k ∫ F ds, of which the run has 20 N for 10 s, then 50 N.
        (motion(duration=20), "kinematics.duration", 20 * 50 / (10 * 20 + 10 * 50)),
        (
            Unidirectional(speed=0.1, track_length=1.0, distance=2.0),
            "kinematics.speed",
            10 * (20 - 50) / (10 * 20 + 10 * 50),
        ),
    ],
)
def test_stages_of_the_load_may_end_with_the_run(slides, path, expected):
    case = run(
        load=[{"until": 10, "normal": 20.0}, {"until": 20, "normal": 50.0}],
        kinematics=slides,
        contact=Winkler(),
    )
    found = gradient(case, Volume("ball"), [path]).relative[path]
    assert found == pytest.approx(expected, rel=1e-7)
