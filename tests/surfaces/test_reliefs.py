"""Rough, wavy and textured bodies on grids too coarse for them."""

import pytest

from tribo import CaseError, Grid, Rough, Texture, Waves


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
        surface.height(Grid((2e-3, 2e-3), (96, 96)))
