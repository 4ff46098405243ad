"""A ring that turns against a block."""

import pytest
from paper_models import archard, flat, foundation, named, small, steel

from tribo import CaseError, Cylinder, Grid, Unidirectional, Waves

RADIUS, LENGTH, LOAD = 20e-3, 1e-3, 50.0
GRID = Grid((3e-3, LENGTH), (60, 4))


def block_on_ring(distance, ring=Cylinder(radius=RADIUS), **motion):  # noqa: B008
    bodies = [
        named("block", flat(), steel(), archard(k=1e-13)),
        named("ring", ring, steel(), archard(k=1e-15)),
    ]
    kinematics = Unidirectional(
        speed=1.0, track_radius=RADIUS, distance=distance, **{"turns": True, **motion}
    )
    return small(
        grid=GRID,
        ends_at_window=True,
        load=LOAD,
        contact=foundation(modulus=1e15),
        bodies=bodies,
        kinematics=kinematics,
    )


def test_a_body_that_is_swept_without_turning_is_refused():
    with pytest.raises(CaseError, match=r"'ring' is swept along x.*with turns = true"):
        block_on_ring(1.0, turns=False)


@pytest.mark.parametrize(
    "ring",
    [
        flat(),
        Cylinder(radius=RADIUS, axis="x"),
        Waves(amplitude="1 nm", wavelength="1 mm", along="x", on=Cylinder(radius=RADIUS)),
        Cylinder(radius="25 mm"),
    ],
)
def test_a_ring_is_round_and_as_large_as_its_track(ring):
    with pytest.raises(CaseError, match="20 mm") as refused:
        block_on_ring(1.0, ring=ring)
    assert refused.value.path == "bodies.ring.surface"


def test_a_ring_with_grooves_round_its_rim_stays_as_it_is():
    grooved = Waves(amplitude="1 nm", wavelength="1 mm", along="y", on=Cylinder(radius=RADIUS))
    assert block_on_ring(1.0, ring=grooved).cycle.maps["ring"].shape_stays
