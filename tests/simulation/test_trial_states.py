"""A model that cannot answer at a state that a step only tries costs the step, not the run."""

from typing import Literal

import numpy as np
import pytest
from paper_models import K, archard, flat, foundation, motion, small, sphere, steel

from tribo import Body, Grid, Simulation
from tribo.core.errors import PluginError
from tribo.plugin import Effect, EffectConfig, Field, WearLaw, WearLawConfig, WearRate


class OnceConfig(WearLawConfig):
    type: Literal["test.once"] = "test.once"


class Once(WearLaw[OnceConfig]):
    """Archard's law, but for one answer at one pressure that is never met again."""

    Config = OnceConfig

    def __init__(self, spoil):
        super().__init__(OnceConfig())
        self.spoil = spoil
        self.at = None

    def rate(self, local):
        k = np.full_like(local.pressure, K)
        depth = k * local.pressure
        self.calls = getattr(self, "calls", 0) + 1
        if self.calls == 8:
            self.at = local.pressure.copy()
        if np.array_equal(local.pressure, self.at):
            depth = self.spoil(depth)
        return WearRate(depth, k)


class HeatConfig(EffectConfig):
    type: Literal["test.heat"] = "test.heat"


class Heat(Effect[HeatConfig]):
    Config = HeatConfig
    provides = (Field("heat", "1", "Not finite at the first trial."),)

    def __init__(self):
        super().__init__(HeatConfig())
        self.seen = []

    def fields(self, contact):
        if not any(np.array_equal(contact.pressure, p) for p in self.seen):
            self.seen.append(contact.pressure.copy())
        first_trial = len(self.seen) > 1 and np.array_equal(contact.pressure, self.seen[1])
        heat = np.full((1, 1), np.inf if first_trial else 1.0)
        return {"heat": dict.fromkeys(contact.materials, heat)}


class HeatedConfig(WearLawConfig):
    type: Literal["test.heated"] = "test.heated"


class Heated(WearLaw[HeatedConfig]):
    Config = HeatedConfig
    requires = ("heat",)

    def rate(self, local):
        k = K * local.fields["heat"]
        return WearRate(k * local.pressure, k)


def model(law, **changes):
    bodies = [Body("ball", sphere(), steel(), law), Body("disk", flat(), steel())]
    return small(
        grid=Grid((0.7e-3, 0.7e-3), (32, 32)),
        bodies=bodies,
        contact=foundation(),
        kinematics=motion(duration=20),
        **changes,
    )


def lost(case):
    with Simulation(case).run() as result:
        assert result.status == "done"
        return result.saves()[-1]["bodies"]["ball"]["wear_volume_m3"]


@pytest.mark.parametrize("spoil", [np.negative, lambda depth: depth * np.nan])
def test_one_bad_answer_of_a_law_is_a_shorter_step(spoil):
    assert lost(model(Once(spoil))) == pytest.approx(lost(model(archard())), rel=1e-9, abs=0)


def test_one_bad_answer_of_an_effect_is_a_shorter_step():
    case = model(Heated(HeatedConfig()), effects=[Heat()])
    assert lost(case) == pytest.approx(lost(model(archard())), rel=1e-9, abs=0)


class WornConfig(WearLawConfig):
    type: Literal["test.worn"] = "test.worn"


class Worn(WearLaw[WornConfig]):
    """Archard's law, negative once a point has slid a metre."""

    Config = WornConfig
    state_fields = (Field("slid", "m", "Path slid."),)

    def rate(self, local):
        k = np.where(local.state["slid"] > 1, -K, K)
        return WearRate(k * local.pressure, np.abs(k), {"slid": np.ones_like(k)})


def test_a_law_that_is_bad_from_a_state_on_ends_the_run_there_by_name(tmp_path):
    with pytest.raises(PluginError, match=r"wear law 'test\.worn' .* negative depth .* at 1 m"):
        Simulation(model(Worn(WornConfig()))).run(tmp_path / "run.h5")


class FickleConfig(WearLawConfig):
    type: Literal["test.fickle"] = "test.fickle"


class Fickle(WearLaw[FickleConfig]):
    """Archard's law, times what `change` makes of the number of calls so far."""

    Config = FickleConfig

    def __init__(self, change):
        super().__init__(FickleConfig())
        self.change = change
        self.calls = 0

    def rate(self, local):
        self.calls += 1
        k = np.full_like(local.pressure, K * self.change(self.calls))
        return WearRate(k * local.pressure, k)


@pytest.mark.parametrize(
    "change",
    [lambda n: 1 + 0.1 * np.sin(n * n), lambda n: 1 + n / 10, lambda n: 1 + 1e-4 * (n % 3)],
    ids=["random", "counts", "nearly the same"],
)
def test_a_law_whose_answer_changes_is_named_with_the_check_that_shows_it(change):
    words = r"wear law 'test\.fickle' of body 'ball' .*tribo plugins check test\.fickle"
    with pytest.raises(PluginError, match=words):
        Simulation(model(Fickle(change))).run()


class RestlessConfig(EffectConfig):
    type: Literal["test.restless"] = "test.restless"


class Restless(Effect[RestlessConfig]):
    Config = RestlessConfig
    provides = (Field("heat", "1", "Another one at each call."),)
    calls = 0

    def fields(self, contact):
        self.calls += 1
        heat = np.full((1, 1), 1 + 0.1 * np.sin(self.calls**2))
        return {"heat": dict.fromkeys(contact.materials, heat)}


def test_an_effect_whose_answer_changes_is_named_before_the_law():
    case = model(Heated(HeatedConfig()), effects=[Restless(RestlessConfig())])
    with pytest.raises(PluginError, match=r"effect 'test\.restless' .*tribo plugins check"):
        Simulation(case).run()
