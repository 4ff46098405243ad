"""Numbers in words and tables."""

import numpy as np
import pytest

from tribo.core.words import readable


@pytest.mark.parametrize("form", [".0f", ".1f", ".2f", ".3f", ".3g"])
def test_what_is_small_is_told_to_a_twentieth(form):
    for value in np.geomspace(1e-12, 1e6, 400):
        assert float(readable(value, form)) == pytest.approx(value, rel=0.051, abs=0)
        assert float(readable(-value, form)) == pytest.approx(-value, rel=0.051, abs=0)
