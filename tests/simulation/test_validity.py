"""What check and the run say where a case leaves what its models hold for."""

import re
from types import SimpleNamespace

import numpy as np
import pytest
from paper_models import archard, flat, named, pair, small, steel

from tribo import Grid, Simulation, TriboWarning
from tribo.motion.unidirectional import Unidirectional
from tribo.simulation.predict import predict
from tribo.simulation.validity import of_case, peak_at_the_edge
from tribo.surfaces.sphere import Sphere


def ball(radius, load, size):
    bodies = [
        named("ball", Sphere(radius=radius), steel(), archard()),
        named("disk", flat(), steel(), archard()),
    ]
    return small(bodies=bodies, load=load, grid=Grid((size, size), (48, 48)))


def circle(revolutions):
    motion = Unidirectional(speed="0.1 m/s", track_length="0.1 m", revolutions=revolutions)
    return small(kinematics=motion)


def wide(model):
    return [problem for problem in predict(model).problems if problem.kind == "half-space"]


def test_a_contact_too_wide_for_a_half_space_is_told_with_the_number():
    # By Hertz a/R = (3 F/(4 E* R²))^(1/3) = 0.4 with E* = 113.7 GPa.
    (problem,) = wide(ball(1e-3, 9.7e3, 1.1e-3))
    assert (problem.value, problem.place) == (pytest.approx(0.4, rel=0.05), "bodies.ball")
    assert wide(ball(1e-3, 100, 0.4e-3)) == []


def test_a_part_of_a_lap_is_told_by_check_and_by_the_run():
    (found,) = of_case(circle(0.1))
    assert (found.kind, found.place) == ("lap", "bodies.disk")
    assert (found.value, found.limit) == pytest.approx((0.01, 0.1))
    with pytest.warns(TriboWarning, match="lap: the run slides 0.01 m, 0.1 of the track"):
        result = Simulation(circle(0.1)).run()
    assert found in result.findings


@pytest.mark.parametrize("revolutions", [1, 10])
def test_a_whole_lap_is_not(revolutions):
    assert of_case(circle(revolutions)) == []


@pytest.mark.parametrize(
    ("radius", "said", "wears"),
    [
        ("4 mm", None, True),
        (
            "0.8 mm",
            r'mm is 0\.[23]\d* of track_radius = 0\.8 mm.*kinematics\.type = "rotating"',
            False,
        ),
    ],
)
def test_a_contact_not_small_beside_its_circle_is_told_by_check_and_by_the_run(radius, said, wears):
    bodies = pair(archard(), archard() if wears else None)
    circle = Unidirectional(speed="0.1 m/s", track_radius=radius, distance="20 m")
    model = small(bodies=bodies, kinematics=circle)
    problems = predict(model).problems
    if said is None:
        assert problems == ()
        assert not Simulation(model.case).run().findings
        return
    (found,) = problems
    assert found.kind == "averaging"
    assert re.search(said, found.words)
    with pytest.warns(TriboWarning, match=said):
        Simulation(model.case).run()


def test_a_ring_on_a_block_has_no_axis_across_its_contact():
    ring = Unidirectional(speed=1, track_radius="1 mm", distance=1, turns=True)
    assert ring.limitation(0.9e-3, 1e-6, 1e-6, 1.0, False) is None
    assert ring.exposures(Grid((3e-3, 3e-3), (8, 8)), ["block", "ring"])["ring"].swept


def test_a_largest_pressure_at_the_edge_alone_is_told():
    x = np.linspace(-1.1, 1.1, 45)
    inside = np.maximum(1 - x[:, None] ** 2 - x**2, 0.0)
    contact = SimpleNamespace(contact=SimpleNamespace(pressure=1e9 * inside))
    assert peak_at_the_edge(contact) is None
    sharp = np.where(inside > 0, 1e8 / np.sqrt(inside + 1e-3), 0.0)
    contact.contact.pressure = sharp
    found = peak_at_the_edge(contact)
    assert (found.kind, found.value) == ("resolution", np.max(sharp))
    assert found.value > found.limit
