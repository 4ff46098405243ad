"""The pair of maps that most tests measure."""

import pytest
from scar_maps import pair

from tribo_scar import measured_scar


@pytest.fixture(scope="session")
def standard():
    """A pair, the depth worn, and what is measured of it."""
    before, after, lost = pair()
    return before, after, lost, measured_scar(before, after)
