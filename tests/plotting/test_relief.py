"""What the history of the contact shows is what the run recorded."""

import numpy as np
from made_results import made

from tribo.plotting.history import history


def test_the_contact_area_is_drawn_with_its_part_at_the_hardness():
    result = made(relief=2e-7, cap=4e8)
    *_, axes = history(result, "contact").figure().axes
    table = result.table("history")
    for line, column in zip(axes.lines, ("contact_area_m2", "plastic_area_m2"), strict=True):
        np.testing.assert_allclose(line.get_ydata(), 1e6 * table[column])
    assert axes.get_ylabel() == "Contact area (mm²)"
