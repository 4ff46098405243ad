"""What strangers wrote holds to the contract, and a law without its effect is named."""

import tomllib

import pytest
from strangers.debris import Covered
from strangers.oxidation import OXIDE, OxideFilm
from strangers.running_in import RunningIn
from strangers.twin_disk import TwinDisk

from tribo import CaseError, Registry, Simulation, hookimpl
from tribo.templates import template
from tribo.testing import parametrize_checks

DISKS = {"ball": "150 mm", "disk": "100 mm"}

test_oxide_film = parametrize_checks(OxideFilm, [{"power": "1 MW/m^2"}])
test_covered = parametrize_checks(Covered, [{"k": "1e-15 1/Pa", "cover": "2 µm"}])
test_running_in = parametrize_checks(
    RunningIn, [{"k_first": "4e-15 1/Pa", "k_last": "1e-15 1/Pa", "length": "2 m"}]
)
test_twin_disk = parametrize_checks(
    TwinDisk,
    [{"speed": "2 m/s", "slip": 0.05, "circumference": DISKS, "duration": "10 min"}],
)


class Oxidised(Covered):
    type = "stranger.oxidised"
    requires = (OXIDE,)


class Offered:
    @hookimpl
    def tribo_components(self):
        return [Oxidised, OxideFilm]


def test_a_missing_effect_is_named_with_the_law_its_place_and_who_provides_it():
    case = tomllib.loads(template("ball_on_disk"))
    case["bodies"]["ball"]["wear"] = {"type": "stranger.oxidised", "k": 1e-15, "cover": 1e-6}
    with pytest.raises(CaseError) as caught:
        Simulation(case, registry=Registry.with_plugins(Offered()))
    message = str(caught.value)
    assert message.startswith("bodies.ball.wear: wear law 'stranger.oxidised' needs ")
    assert OXIDE in message
    assert "effects = [{ type = 'stranger.oxide_film'" in message
