"""A model that cannot answer at a state that a step only tries costs the step, not the run."""

import numpy as np
import pytest
from paper_models import K, archard, foundation, lost, motion, pair, small

from tribo import Field, Grid, Simulation, WearLaw, WearRate
from tribo.core.errors import PluginError

SPOILT = {"negative": np.negative, "nan": lambda h: h * np.nan, "wrong shape": lambda h: h[1:]}


class Once(WearLaw):
    """Archard's law, but for one answer at one pressure that is never met again."""

    spoil: str
    _at: object = None
    _calls: int = 0

    def rate(self, local):
        k = np.full_like(local.pressure, K)
        depth = k * local.pressure
        self._calls += 1
        if self._calls == 8:
            self._at = local.pressure.copy()
        if np.array_equal(local.pressure, self._at):
            depth = SPOILT[self.spoil](depth)
        return WearRate(depth, k)


def model(law, **changes):
    return small(
        grid=Grid((0.7e-3, 0.7e-3), (32, 32)),
        bodies=pair(law),
        contact=foundation(),
        kinematics=motion(duration=20),
        **changes,
    )


@pytest.mark.parametrize("spoil", SPOILT)
def test_one_bad_answer_of_a_law_is_a_shorter_step(spoil):
    assert lost(model(Once(spoil=spoil))) == pytest.approx(lost(model(archard())), rel=1e-9, abs=0)


class Worn(WearLaw):
    """Archard's law, negative once a point has slid a metre."""

    type = "test.worn"

    state_fields = (Field("slid", "m", "Path slid."),)

    def rate(self, local):
        k = np.where(local.state["slid"] > 1, -K, K)
        return WearRate(k * local.pressure, np.abs(k), {"slid": 1.0 * (local.pressure > 0)})


def test_a_law_that_is_bad_from_a_state_on_ends_the_run_there_by_name(tmp_path):
    with pytest.raises(
        PluginError, match=r"wear law 'test\.worn' .*'depth_rate' that is -\S+ somewhere at 0.9999"
    ):
        Simulation(model(Worn())).run(tmp_path / "run.h5")


class Short(Worn):
    """A law that answers with three numbers."""

    type = "test.short"

    def rate(self, local):
        return WearRate(np.zeros(3))


def test_a_rate_of_another_shape_is_refused_with_both_shapes_each_once(tmp_path):
    with pytest.raises(PluginError, match=r"'depth_rate' .*\(3,\) at 0 m .*= \(1, ") as error:
        Simulation(model(Short())).run(tmp_path / "run.h5")
    assert str(error.value).count(" of shape ") == 2


class Ageing(WearLaw):
    """Archard's law, whose state changes where nothing presses too."""

    type = "test.ageing"

    state_fields = (Field("age", "m", "Path of the motion."),)

    def rate(self, local):
        k = np.full_like(local.pressure, K)
        return WearRate(k * local.pressure, k, {"age": np.ones_like(k)})


def test_a_state_that_changes_where_nothing_presses_is_refused():
    with pytest.raises(PluginError, match=r"'rate of age' that is not 0 in \d+ cells where the"):
        lost(model(Ageing()))
