"""Rough, wavy and textured bodies: their statistics."""

import numpy as np
import pytest

from tribo import CaseError, Grid, Rough, Texture, Waves

GRID = Grid((2e-3, 2e-3), (96, 96))
ROUGH = Rough(sq=50e-9, cut_off=1e-4, roll_off=5e-4, hurst=0.8, period=2e-3, seed=3)


def test_another_seed_gives_another_surface():
    other = ROUGH.model_copy(update={"seed": 4}).height(GRID)
    assert abs(np.corrcoef(other.ravel(), ROUGH.height(GRID).ravel())[0, 1]) < 0.3


def test_waves_have_their_crest_at_the_origin():
    grid = Grid((1e-3, 1e-3), (41, 41))
    relief = Waves(amplitude=2e-7, wavelength=5e-4).height(grid)
    assert relief[20, 20] == relief.max() == 2e-7
    np.testing.assert_array_equal(relief, np.broadcast_to(relief[:1], relief.shape))
    rows = Waves(amplitude=2e-7, wavelength=5e-4, along="x").height(grid)
    np.testing.assert_array_equal(rows, relief.T)


@pytest.mark.parametrize(
    ("pattern", "area"), [("dimples", np.pi / 4 * 0.16), ("grooves along y", 0.4)]
)
def test_hollows_take_their_share_of_the_area(pattern, area):
    texture = Texture(depth=2e-6, width=4e-4, pitch=1e-3, pattern=pattern)
    relief = texture.height(Grid((2e-3, 2e-3), (401, 401)))
    assert relief.min() == -2e-6
    assert np.mean(relief < 0) == pytest.approx(area, rel=0.01)


@pytest.mark.parametrize(
    ("surface", "field"),
    [
        (Rough(sq=1e-8, cut_off=3e-5, roll_off=1e-3), "cut_off"),
        (Waves(amplitude=1e-8, wavelength=3e-5), "wavelength"),
        (Texture(depth=1e-6, width=3e-5, pitch=1e-3), "width"),
    ],
)
def test_what_is_finer_than_four_cells_is_refused(surface, field):
    with pytest.raises(CaseError, match=rf"30 µm are .* cells of .*{field}"):
        surface.height(GRID)
