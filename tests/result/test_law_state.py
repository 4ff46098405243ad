"""What a wear law keeps per material point is kept in the result."""

from dataclasses import replace

import numpy as np
import pytest
from paper_models import archard, case, motion, pair, small
from testing.conformance.honest_laws import RunningIn

from tribo import Field, Grid, Implicit, Result, Simulation

LAW = RunningIn(k_first=9e-16, k_last=3e-16, length=20.0)


LOOSE = Implicit(depth_tolerance=0.05, pressure_tolerance=0.5, settle=0.5)
PARTS = {
    "stepping": LOOSE,
    "grid": Grid((0.6e-3, 0.6e-3), (24, 24)),
    "kinematics": motion(duration=60),
}


def model():
    return small(bodies=pair(LAW, LAW), save_times=(20,), **PARTS)


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    path = tmp_path_factory.mktemp("state") / "run.h5"
    Simulation(model().case).run(path).close()
    return path


def test_it_is_read_back_with_unit_and_meaning(path):
    with Result.open(path) as result:
        ball, disk = result.body("ball"), result.body("disk")
        distances = result.distances
        told = result.slid.attrs
    assert told["units"] == "m"
    assert "slid under pressure" in told["long_name"]
    assert ball.state["slid"].shape == disk.state["slid"].shape == (3, 24, 24)
    # What is in contact from the beginning slides all the way, what never is does not.
    np.testing.assert_allclose(ball.state["slid"].max(axis=(1, 2)), distances, rtol=1e-12)
    assert ball.state["slid"].min() == 0
    assert np.all(disk.state["slid"] == disk.state["slid"][:, :1])


@pytest.mark.slow
def test_what_one_law_does_not_keep_is_nan_there_and_a_taken_name_gets_its_kind(tmp_path):
    class Named(RunningIn):
        state_fields = (Field("pressure", "m", "Slid under pressure."),)

        def rate(self, local):
            slid = {"slid": local.state["pressure"]}
            found = super().rate(replace(local, state=slid))
            return replace(found, state_rates={"pressure": found.state_rates["slid"]})

    law = Named(k_first=9e-16, k_last=3e-16, length=20.0)
    with Simulation(case(bodies=pair(law, archard()), **PARTS)).run() as result:
        kept = result.dataset.state_pressure
        assert np.isfinite(kept.sel(body="ball")).all()
        assert np.isnan(kept.sel(body="disk")).all()
        assert list(result.body("ball").state) == ["pressure"]
        assert result.body("disk").state == {}
