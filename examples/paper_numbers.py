"""The arithmetic of "Simulation of a wear experiment", by closed forms alone.

J. Andersson, A. Almqvist and R. Larsson slid a steel ball on a steel disk and
simulated it. Their numbers do not all agree with each other. This script shows
where, and what the rigid limit of their model predicts; it runs no simulation::

    python examples/paper_numbers.py
"""

from __future__ import annotations

from dataclasses import dataclass

from ball_on_track import BallOnTrack, ball_on_track
from scipy.optimize import brentq

from tribo.lab.formulas import ball_cap_depth, ball_cap_volume

LOAD = 100.0  # N
RADIUS = 5e-3  # m, of the ball
STROKE = 2e-3  # m
FREQUENCY = 25.0  # Hz
DURATION = 3600.0  # s
TIME_STEP = 0.25  # s
DENSITY = 7850.0  # kg/m³
BALL_LOSS = 2.0e-6  # kg, weighed, "around"
DISK_LOSS = 0.2e-6  # kg, two readings of a balance that shows 0.1 mg
WEAR_COEFFICIENT = 3.11e-16  # 1/Pa, as printed
IMAGE = (1.24e-3, 0.94e-3)  # m, the widest view of the profilometer
TIMES = (0.0, 200.0, 500.0, 1500.0, 3600.0)  # s, of the published curves
FACTOR = 25.0  # sliding distance behind the printed k over the real one


@dataclass(frozen=True)
class Motion:
    """How far, and how often, the ball slides.

    Parameters
    ----------
    speed : float
        Mean speed 2 · stroke · frequency, in m/s.
    distance : float
        Sliding distance of the test, in m.
    strokes : float
        Single strokes in the test.
    strokes_per_step, cycles_per_step : float
        Single strokes and full cycles in a time step; the paper's average over
        the track asks for whole ones.
    steps : float
        Time steps in the test.
    distance_per_step : float
        Sliding distance of a time step, in m.
    """

    speed: float
    distance: float
    strokes: float
    strokes_per_step: float
    cycles_per_step: float
    steps: float
    distance_per_step: float


@dataclass(frozen=True)
class WearCoefficients:
    """Wear coefficients, in 1/Pa, from the weighed loss of both bodies.

    Parameters
    ----------
    volume : float
        Volume weighed off both bodies, in m³.
    from_distance : float
        With the distance slid, 360 m.
    from_multiplied_distance : float
        With 25 times that, 9000 m: the printed value.
    ball, disk : float
        Of each body by its own loss, with 360 m.
    """

    volume: float
    from_distance: float
    from_multiplied_distance: float
    ball: float
    disk: float


@dataclass(frozen=True)
class Reading:
    """One reading of "the wear is distributed equally between the surfaces".

    Parameters
    ----------
    name : str
        What it takes the words to mean.
    per_body : float
        Volume off each body, in m³.
    total : float
        Volume off both, in m³.
    of_weighed : float
        The total as a part of the weighed volume.
    worn : BallOnTrack
        Geometry at the end of the test, rigid limit.
    """

    name: str
    per_body: float
    total: float
    of_weighed: float
    worn: BallOnTrack


@dataclass(frozen=True)
class Cap:
    """A flat cap that has lost the ball's weighed volume.

    Parameters
    ----------
    radius : float
        Radius of the flat, in m.
    depth : float
        Height of the cap, in m.
    """

    radius: float
    depth: float


@dataclass(frozen=True)
class WeighedSplit:
    """The model run with the weighed volumes, ten to one.

    Parameters
    ----------
    worn : BallOnTrack
        Geometry at the end of the test, rigid limit.
    along, across : float
        Scar diameters, in m.
    stroke_needed : float
        Stroke of ten half-widths, for which the average over it makes the groove
        some percent too deep at mid-stroke, in m.
    """

    worn: BallOnTrack
    along: float
    across: float
    stroke_needed: float


def motion() -> Motion:
    """Count strokes, steps and metres."""
    speed = 2.0 * STROKE * FREQUENCY
    return Motion(
        speed=speed,
        distance=speed * DURATION,
        strokes=2.0 * FREQUENCY * DURATION,
        strokes_per_step=2.0 * FREQUENCY * TIME_STEP,
        cycles_per_step=FREQUENCY * TIME_STEP,
        steps=DURATION / TIME_STEP,
        distance_per_step=speed * TIME_STEP,
    )


def wear_coefficients() -> WearCoefficients:
    """Work out k from the weighed losses."""
    distance = motion().distance
    ball = BALL_LOSS / DENSITY
    disk = DISK_LOSS / DENSITY
    return WearCoefficients(
        volume=ball + disk,
        from_distance=(ball + disk) / (LOAD * distance),
        from_multiplied_distance=(ball + disk) / (LOAD * FACTOR * distance),
        ball=ball / (LOAD * distance),
        disk=disk / (LOAD * distance),
    )


def predict(times: tuple[float, ...], ball: float, disk: float) -> BallOnTrack:
    """Predict the test in the rigid limit.

    Parameters
    ----------
    times : tuple of float
        Times, in s.
    ball, disk : float
        Wear coefficients of the two bodies, in 1/Pa.

    Returns
    -------
    BallOnTrack
    """
    speed = motion().speed
    return ball_on_track(
        [speed * time for time in times],
        load=LOAD,
        radius=RADIUS,
        track_length=STROKE,
        ball_wear_coefficient=ball,
        flat_wear_coefficient=disk,
    )


def readings() -> tuple[Reading, Reading]:
    """Compare both readings of "distributed equally", with the printed k and 360 m."""
    weighed = wear_coefficients().volume

    def read(name: str, k: float) -> Reading:
        worn = predict((DURATION,), k, k)
        total = float(worn.ball_volume[0] + worn.flat_volume[0])
        return Reading(name, 0.5 * total, total, total / weighed, worn)

    return (
        read("each body wears by k p s", WEAR_COEFFICIENT),
        read("each body takes half of k p s", 0.5 * WEAR_COEFFICIENT),
    )


def flat_cap() -> Cap:
    """Take the ball's weighed loss for a flat cap."""
    lost = BALL_LOSS / DENSITY
    diameter = brentq(lambda d: ball_cap_volume(d, RADIUS) - lost, 0.0, 2 * RADIUS, xtol=1e-15)
    return Cap(0.5 * diameter, ball_cap_depth(diameter, RADIUS))


def weighed_split() -> WeighedSplit:
    """Run the rigid limit with the weighed volume of each body."""
    k = wear_coefficients()
    worn = predict((DURATION,), k.ball, k.disk)
    along = 2.0 * float(worn.half_width_along[0])
    return WeighedSplit(worn, along, 2.0 * float(worn.half_width_across[0]), 5.0 * along)


def predictions() -> BallOnTrack:
    """Predict the published times: printed k on each body, s = 0.1 m/s · t."""
    return predict(TIMES, WEAR_COEFFICIENT, WEAR_COEFFICIENT)


def report() -> str:
    """Return all of it as text."""
    return "\n\n".join(
        [
            _motion_text(),
            _coefficient_text(),
            _reading_text(),
            _scar_text(),
            _prediction_text(),
        ]
    )


def main() -> None:
    """Print the report."""
    print(report())


def _motion_text() -> str:
    m = motion()
    return _table(
        "Motion",
        [
            ("speed, 2 strokes of 2 mm at 25 Hz", f"{m.speed:.3g} m/s"),
            ("sliding distance in 1 h", f"{m.distance:.0f} m"),
            ("strokes in 1 h", f"{m.strokes:.0f}"),
            ("steps of 0.25 s", f"{m.steps:.0f}, {1e3 * m.distance_per_step:.0f} mm each"),
            ("strokes per step", f"{m.strokes_per_step:.4g}: the paper asks for a whole number"),
            ("cycles per step", f"{m.cycles_per_step:.4g}: nor is this one"),
        ],
    )


def _coefficient_text() -> str:
    k = wear_coefficients()
    ratio = k.from_distance / k.from_multiplied_distance
    return _table(
        "Wear coefficient from 2.2 mg weighed off both bodies",
        [
            ("volume", f"{1e9 * k.volume:.4f} mm³"),
            ("k with 360 m", _k(k.from_distance)),
            ("k with 25 · 360 m = 9000 m", _k(k.from_multiplied_distance)),
            ("k as printed", _k(WEAR_COEFFICIENT)),
            ("between the first two", f"{ratio:.3g}: the frequency, counted twice"),
            ("k of the ball alone, 360 m", _k(k.ball)),
            ("k of the disk alone, 360 m", _k(k.disk)),
        ],
    )


def _reading_text() -> str:
    rows = []
    for reading in readings():
        worn = reading.worn
        rows += [
            (
                reading.name,
                f"{1e9 * reading.total:.4f} mm³ off both, "
                f"{100 * reading.of_weighed:.0f} % of weighed",
            ),
            (
                "  half-widths along, across; crown",
                f"{1e6 * worn.half_width_along[0]:.0f}, {1e6 * worn.half_width_across[0]:.0f} µm; "
                f"{1e6 * worn.flat_depth[0]:.2f} µm",
            ),
        ]
    return _table('"Distributed equally", printed k, 360 m', rows)


def _scar_text() -> str:
    cap, split = flat_cap(), weighed_split()
    image = f"{1e3 * IMAGE[0]:.2f} × {1e3 * IMAGE[1]:.2f} mm"
    return _table(
        "The scar of a ball that lost 2.0 mg",
        [
            (
                "flat cap",
                f"radius {1e3 * cap.radius:.2f} mm, depth {1e6 * cap.depth:.0f} µm",
            ),
            ("widest image of it", image),
            (
                "rigid limit, weighed volumes",
                f"{1e3 * split.along:.2f} × {1e3 * split.across:.2f} mm, "
                f"depth {1e6 * split.worn.ball_depth[0]:.1f} µm",
            ),
            (
                "  crown",
                f"{1e6 * split.worn.flat_depth[0]:.2f} µm; the paper shows about 10 µm",
            ),
            (
                "  stroke of ten half-widths",
                f"{1e3 * split.stroke_needed:.1f} mm; the paper has {1e3 * STROKE:.0f} mm",
            ),
        ],
    )


def _prediction_text() -> str:
    worn = predictions()
    columns = [
        ("time, s", [f"{t:.0f}" for t in TIMES]),
        ("distance, m", [f"{s:.0f}" for s in worn.distance]),
        ("half-width along, µm", [f"{1e6 * v:.0f}" for v in worn.half_width_along]),
        ("half-width across, µm", [f"{1e6 * v:.0f}" for v in worn.half_width_across]),
        ("centre pressure, MPa", [f"{1e-6 * v:.0f}" for v in worn.centre_pressure]),
        ("edge pressure, MPa", [f"{1e-6 * v:.0f}" for v in worn.peak_pressure]),
        ("ball depth, µm", [f"{1e6 * v:.2f}" for v in worn.ball_depth]),
        ("flat depth = crown, µm", [f"{1e6 * v:.2f}" for v in worn.flat_depth]),
    ]
    lines = [name.ljust(24) + "".join(cell.rjust(9) for cell in cells) for name, cells in columns]
    title = "Predictions, rigid limit (elastic displacement left out), each body wears by k p s"
    return "\n".join([title, "-" * len(title), *lines])


def _k(value: float) -> str:
    return f"{value:.3e} 1/Pa = {1e9 * value:.3e} mm³/(N·m)"


def _table(title: str, rows: list[tuple[str, str]]) -> str:
    return "\n".join([title, "-" * len(title), *(f"{name:<36}{value}" for name, value in rows)])


if __name__ == "__main__":
    main()
