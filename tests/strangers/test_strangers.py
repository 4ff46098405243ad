"""What strangers wrote holds to the contract, and a law without its effect is named."""

import pytest
from strangers.debris import Covered
from strangers.oxidation import OXIDE, OxideFilm
from strangers.twin_disk import TwinDisk

from tribo import CaseError, Simulation, load_case
from tribo.testing import parametrize_checks

DISKS = {"ball": "150 mm", "disk": "100 mm"}

test_oxide_film = parametrize_checks(OxideFilm, [{"power": "1 MW/m^2"}])
test_covered = parametrize_checks(Covered, [{"k": "1e-15 1/Pa", "cover": "2 µm"}])
test_twin_disk = parametrize_checks(
    TwinDisk,
    [{"speed": "2 m/s", "slip": 0.05, "circumference": DISKS, "duration": "10 min"}],
)


class Oxidised(Covered):
    type = "stranger.oxidised"
    requires = (OXIDE,)


def test_a_missing_effect_is_named_with_the_law_and_its_place():
    case = load_case("tribo/templates/ball_on_disk.toml")
    law = Oxidised(k=1e-15, cover=1e-6)
    bodies = {name: b.model_copy(update={"wear": law}) for name, b in case.bodies.items()}
    with pytest.raises(CaseError, match=rf"needs {OXIDE}") as caught:
        Simulation(case.model_copy(update={"bodies": bodies}))
    assert caught.value.path == "bodies.ball.wear"
