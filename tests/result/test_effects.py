"""What effects compute is kept in the result, for the pressure saved with it."""

import numpy as np
import pytest
from paper_models import StopAfter, small
from strangers.oxidation import OXIDE, OxideFilm

from tribo import CaseError, Field, Interrupted, Result, Simulation, TriboError

POWER, FRICTION, SPEED = 1e7, 0.1, 0.1


def film():
    return OxideFilm(power=POWER)


def model(effect=None):
    return small(effects=[effect or film()], friction_coefficient=FRICTION, save_times=(20, 100))


def expected(pressure):
    heat = FRICTION * pressure * SPEED
    return heat / (heat + POWER)


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    path = tmp_path_factory.mktemp("effects") / "run.h5"
    Simulation(model().case).run(path).close()
    return path


def test_each_save_has_the_field_of_its_own_pressure(path):
    with Result.open(path) as result:
        for name in ("ball", "disk"):
            kept = result.body(name).effects[OXIDE]
            assert kept.shape == (4, 48, 48)
            for save in range(4):
                np.testing.assert_allclose(
                    kept[save], expected(result.field("pressure", save)), rtol=1e-9, atol=0
                )


class Fails(OxideFilm):
    def fields(self, contact):
        raise ValueError("too hot")


def test_where_an_effect_fails_the_rest_of_the_save_stays(tmp_path):
    path = tmp_path / "failed.h5"
    with pytest.raises(TriboError, match="too hot"):
        Simulation(model(Fails(power=POWER))).run(path)
    with Result.open(path) as result:
        assert np.isfinite(result.field("pressure", 0)).all()
        assert np.isnan(result.body("ball").effects[OXIDE]).all()


class Renamed(OxideFilm):
    provides = (Field("film", "1", "Part of the surface under oxide."),)

    def fields(self, contact):
        return {"film": super().fields(contact)[OXIDE]}


def test_a_stopped_run_has_it_too_and_does_not_resume_with_other_fields(tmp_path):
    stopped = tmp_path / "stopped.h5"
    with pytest.raises(Interrupted):
        Simulation(model().case).run(stopped, observers=[StopAfter(steps=8)])
    with Result.open(stopped) as result:
        last = result.body("disk").effects[OXIDE][-1]
        wanted = expected(result.field("pressure", -1))
    np.testing.assert_allclose(last, wanted, rtol=1e-9, atol=0)
    changed = Simulation(model(Renamed(power=POWER)))
    with pytest.raises(CaseError, match=f"provide film, but the result keeps {OXIDE}"):
        changed.resume(stopped, allow_changed=True)
