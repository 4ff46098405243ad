import pytest
from paper_models import small, states


@pytest.fixture(scope="session")
def paper_small():
    return states(small())
