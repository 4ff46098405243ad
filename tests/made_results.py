"""Results made up in memory: Hertz's pressure spreading out, parabolic scars."""

import numpy as np

from tribo.core.contact import ContactSolution, ContactSystem, Residuals
from tribo.core.fields import Field
from tribo.core.grid import Grid
from tribo.core.measures import BodyMeasures, Measures, centre, contact_area, half_widths
from tribo.core.state import BodyInfo, BodyState, RunInfo, Snapshot, State
from tribo.observers.recorder import Recorder
from tribo.plotting import figures
from tribo.result.provenance import environment

GRID = Grid((2e-3, 1.6e-3), (50, 40))
RADIUS = 5e-3
TIMES = (0.0, 200.0, 500.0, 1500.0, 3600.0)
FILM = (Field("film", "m", "Thickness of a film."),)
SHARE = (Field("load_share", "1", "Share of the load that the film bears."),)
SETTLED = Residuals(0.0, 0.0, 0.0)
ENDLESS = 1e9
SHAPES = {
    "line contact": {"shape": (0.3, ENDLESS), "curvature": (200.0, 0.0)},
    "flat pin": {"shape": (ENDLESS, ENDLESS), "power": 1e-9, "curvature": None},
    "rough": {"texture": 0.6, "curvature": None},
    "long window": {"grid": Grid((10e-3, 1e-3), (100, 20)), "shape": (4.0, 0.4)},
    "1:1000": {"grid": Grid((1e-3, 1.0), (40, 40)), "shape": (0.3, 300.0)},
    "hard": {"cap": 2e9},
}
"""Contacts of every shape: what `made` takes for each."""


def made(
    times=TIMES,
    *,
    names=("ball", "disk"),
    swept=(False, True),
    worn=(True, True),
    densities=(7850.0, 7850.0),
    curvature=(1 / RADIUS, 1 / RADIUS),
    cap=None,
    plastic=0.0,
    power=0.5,
    shape=(1.0, 1.1),
    status="done",
    grid=GRID,
    texture=0.0,
    relief=0.0,
    film=0.0,
    layers=(),
):
    """Return a result in which the contact grows as that of a ball worn flat.

    The pressure goes as ``(1 - r²/a²)**power``; `shape` are the half-widths along x and y in
    parts of a, `texture` the part of the pressure that comes and goes from cell to cell, `relief`
    the amplitude in m of waves on the first body. A `film`, in m/s, grows between the bodies and
    takes a share of the load that all of them see. `layers` are the tables of those of the first
    body, of which none is worn through.
    """
    bodies = tuple(zip(names, swept, worn, densities, strict=True))
    writer = Recorder()
    writer.on_start(
        RunInfo(
            system=ContactSystem(grid, 1.137e11, 100.0, cap, curvature),
            bodies=tuple(
                BodyInfo(
                    name,
                    is_swept,
                    density,
                    _height(grid, i, relief),
                    grid.cells[0],
                )
                for i, (name, is_swept, _, density) in enumerate(bodies)
            ),
            end_time=3600.0,
            end_distance=360.0,
            case={
                "grid": grid.model_dump(),
                "bodies": {
                    name: {
                        "material": {"hardness": cap},
                        "layers": list(layers) if name == names[0] else [],
                    }
                    for name in names
                },
            },
            provenance={**environment(), "components": {}, "plugins": []},
            between_fields=FILM if film else (),
            effect_fields=SHARE if film else (),
        )
    )
    looks = bodies, plastic, power, shape, grid, texture, cap, relief, film
    for before, time in zip((0.0, *times), times, strict=False):
        snapshot = _snapshot(time, *looks)
        # Two steps to each save.
        if time > 0:
            writer.on_step(_snapshot(0.1 * before + 0.9 * time, *looks))
        writer.on_step(snapshot)
        writer.on_save(snapshot)
    writer.on_finish(None, status)
    return writer.result()


def written(path, **options):
    """Write what `made` returns to a file."""
    with made(**options) as result:
        result.save(path)
    return path


def quick_reports(monkeypatch):
    """Let two pictures stand for all of a result."""

    def two(result, *tell, every=figures.result_pictures):
        return dict(list(every(result).items())[:2])

    for module in ("tribo.plotting.figures", "tribo_report.result"):
        monkeypatch.setattr(f"{module}.result_pictures", two)


def empty_pictures(monkeypatch):
    """Let pictures be drawn, but their files stay empty."""
    monkeypatch.setattr("matplotlib.figure.Figure.savefig", lambda *given, **named: None)


def half_width(time):
    """Half-width of the contact along x; it is a tenth wider along y."""
    return 1.5e-4 * (1 + time / 20) ** 0.25


def _height(grid, body, relief):
    x, y = grid.mesh
    waves = relief * np.cos(4e4 * x) * np.cos(3e4 * y)
    return waves - (x**2 + y**2) / (2 * RADIUS) if body == 0 else np.zeros(grid.cells)


def _snapshot(time, bodies, plastic, power, shape, grid, texture, cap, relief, film):
    x, y = grid.mesh
    a = half_width(time)
    inside = np.maximum(1 - ((x / shape[0]) ** 2 + (y / shape[1]) ** 2) / a**2, 0.0)
    pressure = np.where(inside > 0, inside**power, 0.0)
    i, j = np.indices(grid.cells)
    pressure *= 1 + texture * np.cos(1.7 * i) * np.cos(1.3 * j)
    pressure *= 100.0 / (pressure.sum() * grid.cell_area)
    # What levels a ball, and a tenth of it for a groove.
    depth = (a**2 - half_width(0.0) ** 2) / (2 * RADIUS) * inside
    states, measures = {}, {}
    for name, swept, wears, _ in bodies:
        field = depth if wears else 0 * depth
        wear = 0.1 * field.mean(axis=0, keepdims=True) if swept else field
        states[name] = BodyState(wear, plastic * inside, {})
        volume = 3.11e-14 * 0.1 * time if wears else 0.0
        deepest = plastic * inside.max()
        measures[name] = BodyMeasures(wear.max(), centre(wear), volume, deepest)
    state = State(
        time=time,
        distance=0.1 * time,
        bodies=states,
        contacts=(ContactSolution(pressure, 1e-6, 0 * pressure, 1, SETTLED),),
        increment=1.0,
        reference_depth=1e-6,
        load_distance=10.0 * time,
        between={"film": film * time * inside} if film else {},
    )
    width, breadth = half_widths(state.contact, grid)
    return Snapshot(
        state,
        Measures(
            time=time,
            distance=0.1 * time,
            load=100.0,
            load_distance=10.0 * time,
            max_pressure=pressure.max(),
            centre_pressure=centre(pressure),
            half_width_x=width,
            half_width_y=breadth,
            area=contact_area(pressure, grid),
            plastic_area=0.0 if cap is None else contact_area(pressure >= cap, grid),
            approach=1e-6,
            residuals=SETTLED,
            contact_solves=1,
            solver_iterations=1,
            bodies=measures,
        ),
        {"load_share": dict.fromkeys(states, film * 1e5 * inside * time)} if film else {},
    )
