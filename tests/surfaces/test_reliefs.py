"""Rough, wavy and textured bodies: their statistics."""

import numpy as np
import pytest

from tribo import CaseError, Grid, Rough, Sphere, Texture, Waves

GRID = Grid((2e-3, 2e-3), (96, 96))
ROUGH = Rough(sq=50e-9, cut_off=1e-4, roll_off=5e-4, hurst=0.8, period=2e-3, seed=3)


def power(relief, grid):
    """Return the wavenumbers (1/m) of a relief's waves and their power."""
    modes = np.abs(np.fft.fft2(relief) / relief.size) ** 2
    qx, qy = (np.fft.fftfreq(n, size / n) for n, size in zip(grid.cells, grid.size, strict=True))
    return np.hypot(qx[:, None], qy), modes


def test_a_rough_surface_has_its_height_and_its_spectrum():
    relief = ROUGH.height(GRID)
    assert relief.mean() == pytest.approx(0, abs=1e-20)
    assert relief.std() == pytest.approx(50e-9, rel=1e-12, abs=0)
    q, modes = power(relief, GRID)
    assert modes[q > 1.001e4].max() < 1e-28
    rolled, steep = (q > 100) & (q <= 2e3), (q > 2e3) & (q <= 1e4)
    assert np.ptp(modes[rolled]) < 1e-6 * modes.max()
    slope = np.polyfit(np.log(q[steep]), np.log(modes[steep]), 1)[0]
    assert slope == pytest.approx(-2 * (1 + 0.8), rel=1e-3)


def test_another_seed_gives_another_surface():
    other = ROUGH.model_copy(update={"seed": 4}).height(GRID)
    assert abs(np.corrcoef(other.ravel(), ROUGH.height(GRID).ravel())[0, 1]) < 0.3


def test_a_lay_stretches_the_waves_along_the_sliding_direction():
    along, across = np.gradient(
        ROUGH.model_copy(update={"stretch": 4.0}).height(Grid((2e-3, 2e-3), (256, 256)))
    )
    assert np.std(across) / np.std(along) == pytest.approx(4, rel=0.15)


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


def test_a_relief_lies_on_another_surface():
    on = Sphere(radius=5e-3)
    laid = Waves(amplitude=1e-7, wavelength=3e-4, on=on).height(GRID)
    np.testing.assert_allclose(
        laid - on.height(GRID), Waves(amplitude=1e-7, wavelength=3e-4).height(GRID), atol=1e-18
    )


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
