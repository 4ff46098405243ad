"""Cases with classes that no plugin offers, in all that is done with cases."""

from typing import Annotated

import numpy as np
import pytest
from own_law import Halved
from paper_models import K, archard, small
from tribo_inverse import calibrate

from tribo import Archard, CaseError, Grid, Quantity, Stop, WearLaw, WearRate, compare, sweep


def case(law=None):
    plain = small(grid=Grid((0.7e-3, 0.7e-3), (20, 20))).case
    worn = {
        n: b.model_copy(update={"wear": law or Halved(k=2 * K)}) for n, b in plain.bodies.items()
    }
    return plain.model_copy(update={"bodies": worn, "stop": Stop(distance=4)})


def worn(result, body="ball"):
    return result.saves()[-1]["bodies"][body]["wear_volume_m3"]


def test_variants_results_and_cases_are_compared():
    plain = case(archard(K)).run()
    with compare(case(), {"bodies.ball.wear.k": [2 * K, 4 * K]}) as varied:
        one, two = map(worn, varied.results.values())
    assert one == pytest.approx(worn(plain), rel=1e-6, abs=0)
    assert two > 1.5 * one
    with compare([plain, case()], labels=["plain", "mine"]) as both:
        assert list(both.results) == ["plain", "mine"]
        assert worn(both.results["mine"]) == pytest.approx(
            worn(both.results["plain"]), rel=1e-6, abs=0
        )
    with compare([case(), case(archard(K)).run()]) as both:
        assert list(both.results) == ["case 1", "result 2"]


def test_the_case_of_a_result_has_the_class():
    result = case().run()
    assert result.case == case()
    assert isinstance(result.case.bodies["ball"].wear, Halved)
    assert result.case_tables["bodies"]["ball"]["wear"] == {"type": "own.halved", "k": 2 * K}


def test_workers_of_a_sweep_import_the_class(tmp_path):
    rates = {"bodies.ball.wear.k": [2 * K, 4 * K]}
    found = sweep(case(), rates, tmp_path, jobs=1)
    assert list(found.table["status"]) == ["done", "done"]

    class Local(Halved):
        type = "own.local"

    found = sweep(case(Local(k=K)), rates, tmp_path / "local", jobs=1)
    assert set(found.table["status"]) == {"failed"}
    assert found.table["message"].str.contains("outside of any function").all()


def test_a_coefficient_of_the_law_is_found():
    made, body = case().run(), {"body": "ball", "uncertainty": 1e-15}
    measured = {
        "fit": [{"path": "bodies.ball.wear.k"}],
        "measured": [{**body, "quantity": "volume", "value": worn(made)}],
    }
    found = calibrate(case(Halved(k=K)), measured)
    assert found.parameters["value"].iloc[0] == pytest.approx(2 * K, rel=1e-3, abs=0)


def test_a_name_of_a_plugin_is_refused_and_the_last_of_a_name_counts():
    class Mine(WearLaw):
        type = "archard"

        def rate(self, local):
            return WearRate(np.zeros_like(local.pressure))

    with pytest.raises(CaseError, match=r"Mine has the type 'archard'.*as 'my\.archard'"):
        compare(case(Mine()), {"load.normal": [1, 2]})

    def again(factor):
        class Again(WearLaw):
            type = "own.again"
            k: Annotated[float, Quantity("1/Pa")] = K

            def rate(self, local):
                return WearRate(factor * self.k * local.pressure)

        return case(Again())

    for factor in (1.0, 0.5):
        with compare(again(factor), {"load.normal": [100, 101]}) as found:
            by_load = [*map(worn, found.results.values())]
        assert by_load[0] == pytest.approx(worn(case(Archard(k=factor * K)).run()), rel=1e-6, abs=0)


def test_a_case_says_what_it_will_do_and_a_result_shows_itself(capsys):
    assert case().check().exit_code == 0
    result = case().run(progress=True)
    result.show()
    assert "Wear after" in capsys.readouterr().out
    assert len(result.picture("ball_scar").axes) >= 1
    with pytest.raises(CaseError, match="no picture 'ball_scars'; did you mean 'ball_scar'"):
        result.picture("ball_scars")
