"""What strangers wrote holds to the contract."""

from strangers.debris import Covered
from strangers.oxidation import OxideFilm
from strangers.twin_disk import TwinDisk

from tribo.testing import parametrize_checks

DISKS = {"ball": "150 mm", "disk": "100 mm"}

test_oxide_film = parametrize_checks(OxideFilm, [{"power": "1 MW/m^2"}])
test_covered = parametrize_checks(Covered, [{"k": "1e-15 1/Pa", "cover": "2 µm"}])
test_twin_disk = parametrize_checks(
    TwinDisk,
    [{"speed": "2 m/s", "slip": 0.05, "circumference": DISKS, "duration": "10 min"}],
)
