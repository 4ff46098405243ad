import numpy as np
import pytest
from paper_models import K, archard, pair, small

from tribo.core.errors import CaseError
from tribo.evolution.interval import Moment
from tribo.simulation.run import Simulation
from tribo.stepping.explicit import Explicit, largest_stable_increment
from tribo.stepping.first_contact import first_contact


def test_steps_that_cannot_do_are_refused_before_anything_is_written(tmp_path):
    model = small(bodies=pair(archard()), stepping=Explicit(time_step="60 s"), save_times=(1.0,))
    # Δs < 2 · 0.58069 Δ/(k E*)
    spacing = model.grid.spacing[0]
    limit = 2 * 0.58069 * spacing / (K * model.contact.system.modulus) / 0.1
    with pytest.raises(CaseError, match=r"stepping\.time_step: .*largest stable step") as caught:
        Simulation(model.case).run(tmp_path / "run.h5")
    stated = float(str(caught.value).split("stable step is ")[1].split(" s")[0])
    assert stated == pytest.approx(limit, rel=1e-3)
    with pytest.raises(CaseError, match="would take"):
        Simulation(small(stepping=Explicit(time_step=1e-30)).case).run(tmp_path / "run.h5")
    assert list(tmp_path.iterdir()) == []


def test_where_only_the_track_wears_the_limit_counts_the_part_of_it_in_contact():
    # λ <= k (2b/ℓ)/K̂: a point of the track is in contact for 2b of every ℓ slid.
    bodies = pair(disk=archard())
    model = small(bodies=bodies)
    state = first_contact(model)
    touching = np.count_nonzero(state.contact.pressure > 0, axis=0).max()
    spacing = model.grid.spacing[0]
    expected = (
        2 * 0.58069 * spacing / (K * model.contact.system.modulus * touching * spacing / 2e-3)
    )
    limit = largest_stable_increment(model, state, Moment(0.0, 0.0, 0.1))
    assert limit == pytest.approx(expected, rel=1e-3)
