import pytest

from tribo.core.errors import CaseError
from tribo.core.material import Material
from tribo.wear.archard import Archard


def test_archard_needs_a_hardness_for_the_coefficient():
    soft = Material(young="207 GPa", poisson=0.3)
    with pytest.raises(CaseError, match="K needs a hardness"):
        Archard(K=1e-6).check(soft)


@pytest.mark.parametrize("given", [{}, {"k": 1e-15, "K": 1e-6}])
def test_archard_takes_one_coefficient(given):
    with pytest.raises(CaseError, match="exactly one of k"):
        Archard(**given)
