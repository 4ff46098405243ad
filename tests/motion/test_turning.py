"""A ring that turns against a block."""

import numpy as np
import pytest
from paper_models import archard, flat, foundation, last, named, small, steel

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


def test_a_ring_stays_round_and_its_block_takes_its_shape():
    distance = 20 / 3
    model = block_on_ring(distance)
    bodies = last(model).bodies
    ring, block = bodies["ring"].wear, bodies["block"].wear
    # All of the ring loses the same.
    worn = 1e-15 * LOAD * distance / (2 * np.pi * RADIUS * LENGTH)
    np.testing.assert_allclose(ring, np.full((1, 4), worn), rtol=1e-6)
    volume = 1e-13 * LOAD * distance
    assert model.cycle.maps["block"].volume(block) == pytest.approx(volume, rel=1e-6, abs=0)
    # ASTM G77: the scar is a segment of the ring's circle, of section 2c³/3R for a half-width c.
    half = (1.5 * RADIUS * volume / LENGTH) ** (1 / 3)
    depth = np.maximum(half**2 - GRID.x**2, 0) / (2 * RADIUS)
    # What is off is the elastic overlap, 1 % of the depth, and cells at the rim.
    np.testing.assert_allclose(block[:, 2], depth, atol=0.03 * depth.max())


def test_a_body_that_is_swept_without_turning_is_refused():
    with pytest.raises(CaseError, match=r"'ring' is swept along x.*with turns = true"):
        block_on_ring(1.0, turns=False)


@pytest.mark.parametrize(
    ("ring", "words"),
    [
        (flat(), "a 'flat', is not round"),
        (Cylinder(radius=RADIUS, axis="x"), "a 'cylinder', is not round"),
        (
            Waves(amplitude="1 nm", wavelength="1 mm", along="x", on=Cylinder(radius=RADIUS)),
            "is not round",
        ),
        (Cylinder(radius="25 mm"), r"radius is 25 mm, the track's 20 mm; .* = 0\.025"),
    ],
)
def test_a_ring_is_round_and_as_large_as_its_track(ring, words):
    with pytest.raises(CaseError, match=rf"bodies\.ring\.surface: body 'ring' turns.*{words}"):
        block_on_ring(1.0, ring=ring)


def test_a_ring_with_grooves_round_its_rim_stays_as_it_is():
    grooved = Waves(amplitude="1 nm", wavelength="1 mm", along="y", on=Cylinder(radius=RADIUS))
    assert block_on_ring(1.0, ring=grooved).cycle.maps["ring"].shape_stays
