"""What a stranger's law and effect need is named where it is missing."""

import pytest
from paper_models import case, pair
from strangers import laws
from strangers.oxidation import OxideFilm
from strangers.protected import Protected

from tribo import CaseError, Registry, Simulation

LAW = Protected(k="1e-15 1/Pa")


def composed(*effects):
    made = case(bodies=pair(LAW, LAW), effects=effects)
    return Simulation(made, registry=Registry.with_plugins(laws))


def test_a_missing_effect_is_named_with_the_law_and_its_place():
    with pytest.raises(CaseError) as caught:
        composed()
    message = str(caught.value)
    assert message.startswith("bodies.ball.wear: wear law 'stranger.protected' needs ")
    assert "stranger_oxide" in message
    assert "these do: 'stranger.oxide_film' (" in message


def test_what_an_effect_requires_of_the_case_is_named_too():
    with pytest.raises(CaseError, match=r"'stranger\.oxide_film' needs a coefficient of friction"):
        composed(OxideFilm(power="50 MW/m^2"))
