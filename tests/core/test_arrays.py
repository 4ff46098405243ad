"""Rows and columns of a field that is periodic are counted round."""

import numpy as np
import pytest

from tribo.core.arrays import region

FIELD = np.arange(12.0).reshape(4, 3)


@pytest.mark.parametrize("first", [(0, 0), (1, 1), (3, 0), (0, 2), (-1, -1), (9, 5)])
def test_a_part_is_taken_from_a_cell_on_and_added_there(first):
    part, added = FIELD[region(FIELD, first, (3, 2))], np.zeros_like(FIELD)
    np.testing.assert_array_equal(part, np.roll(FIELD, [-first[0], -first[1]], (0, 1))[:3, :2])
    added[region(added, first, part.shape)] += part
    np.testing.assert_array_equal(added, np.where(np.isin(FIELD, part), FIELD, 0.0))
