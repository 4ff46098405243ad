"""What strangers wrote holds to the contract."""

from strangers.oxidation import OxideFilm
from strangers.protected import Protected
from strangers.running_in import RunningIn
from strangers.twin_disk import TwinDisk

from tribo.testing import parametrize_checks

DISKS = {"ball": "150 mm", "disk": "100 mm"}

test_oxide_film = parametrize_checks(OxideFilm, [{"power": "1 MW/m^2"}])
test_protected = parametrize_checks(
    Protected, [{"k": "1e-15 1/Pa"}], fields={"stranger_oxide": 0.5}
)
test_running_in = parametrize_checks(
    RunningIn, [{"k_first": "4e-15 1/Pa", "k_last": "1e-15 1/Pa", "length": "2 m"}]
)
test_twin_disk = parametrize_checks(
    TwinDisk,
    [{"speed": "2 m/s", "slip": 0.05, "circumference": DISKS, "duration": "10 min"}],
)
