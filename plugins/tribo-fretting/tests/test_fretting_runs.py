"""Wear of a ball that frets."""

import numpy as np
import pytest
from fretting_problems import LOAD, MU, STEEL, K, case
from tribo import Case, CaseError, Simulation
from tribo.study.check import check_case

from tribo_fretting import drive
from tribo_fretting.motion import Fretting
from tribo_fretting.projected_cg import dragged


def run(*args, **changes):
    with Simulation(case(*args, **changes)).run() as result:
        volume = result.saves()[-1]["bodies"]["ball"]["wear_volume_m3"]
        return volume, float(result.dataset["friction_energy"][-1]), result.totals()


STAGES = [{"until": "2000 s", "amplitude": "2 um"}, {"until": "5000 s", "amplitude": "3 um"}]


@pytest.mark.parametrize(
    "changes",
    [
        {"motion": {"cycles": 37.5}},
        {"amplitude": STAGES},
        {
            "motion": {"direction": "free", "stiffness": "50 N/um"},
            "amplitude": "4 um",
            "k": 1e-16,
        },
    ],
    ids=["few cycles", "stages", "free on a rig"],
)
def test_worn_volume_goes_with_the_energy_of_the_loops(changes):
    volume, energy, _ = run(**changes)
    assert volume == pytest.approx(changes.get("k", K) / MU * energy, rel=1e-10, abs=0)


def test_a_hundred_thousand_cycles_take_few_solves(monkeypatch):
    tangential = []
    monkeypatch.setattr(drive, "dragged", lambda *of: tangential.append(of) or dragged(*of))
    assert run(cells=128)[2]["contact_solves"] <= 60
    assert 30 < len(tangential) <= 120


def test_the_energy_law_wears_by_the_slip():
    pytest.importorskip("tribo_energy")
    plain, _, _ = run(k=1e-16)
    law = {"type": "energy.dissipation", "alpha": 1e-16 / MU}
    dissipating, _, _ = run(law=law, effects=[{"type": "energy.friction_traction"}])
    assert dissipating == pytest.approx(plain, rel=1e-6, abs=0)


def test_running_in_goes_with_the_slip_of_each_point():
    # k is so small that the pressure stays: D is the depth over k.
    k, over, factor = 1e-20, 1e8, 4.0
    law = {"type": "archard", "k": k}
    laws = law, {"type": "running_in", "law": law, "factor": factor, "over": over}
    plain, fresh = (
        Simulation(case(32, law=law)).run().field("wear_depth", -1, "ball") for law in laws
    )
    more = (factor - 1) * k * over * (1 - np.exp(-plain / (k * over)))
    assert 0.5 < np.max(plain) / (k * over) < 10
    assert fresh == pytest.approx(plain + more, abs=1e-4 * fresh.max())


def test_stages_lead_along_their_own_path():
    motion = Fretting(amplitude=STAGES, frequency=20, duration=4000)
    path = 4 * 20 * 2000 * np.array([2e-6, 2e-6 + 3e-6])
    assert [motion.distance_at(t) for t in (2000, 4000)] == pytest.approx(path, rel=1e-12, abs=0)
    assert motion.time_at(motion.distance_at(3000.0)) == pytest.approx(3000, rel=1e-12, abs=0)
    assert motion.edges == [2000]


def bodies(**changes):
    other = case()["bodies"]
    return {name: {**of, **changes} for name, of in other.items()}


LONG = [STAGES[0], {"until": "5000 s", "amplitude": "100 um"}]
ALUMINIUM = {"young": "70 GPa", "poisson": 0.33}
LAYER = {"thickness": "1 um", "young": "400 GPa"}
WITHIN = [{"until": "0.02 s", "normal": 0.8 * LOAD}, {"until": "2 h", "normal": LOAD}]
REFUSED = {
    "no friction": ({"friction": None}, "coefficient of friction"),
    "friction of 0": ({"friction": {"coefficient": 0}}, "friction is 0"),
    "springs": ({"contact": {"type": "winkler", "modulus": 1e15}}, "winkler"),
    "repeating": ({"contact": {"type": "periodic"}}, "periodic"),
    "layer": (
        {"bodies": bodies(layers=[LAYER], wear={"type": "archard", "k": 0})},
        "elastic layer",
    ),
    "load in a cycle": ({"load": {"normal": WITHIN}}, r"load\.normal: .* changes by 20 %"),
    "hardness": ({"bodies": bodies(material={**STEEL, "hardness": "1 GPa"})}, "1 GPa"),
    "long stage": ({"amplitude": LONG}, r"amplitude\.2\.amplitude: .*reciprocating"),
    "sticks": ({"amplitude": "1 nm"}, r"kinematics\.amplitude: .*all sticks"),
    "held": (
        {"motion": {"force_amplitude": 0.1, "cycles": 1}},
        r"kinematics\.force_amplitude: .*all",
    ),
    "two ends": ({"motion": {"duration": "1 s"}}, "exactly one"),
    "short stages": ({"amplitude": STAGES, "motion": {"cycles": 2e5}}, "5000 s"),
    "passing": (
        {
            "kinematics": {
                "type": "reciprocating",
                "stroke": "2 mm",
                "frequency": 1,
                "cycles": 5,
                "positions": "average",
            },
            "effects": [{"type": "fretting.partial_slip", "amplitude": "1 um"}],
        },
        "pass through",
    ),
}


UNLIKE = bodies() | {"flat": {"surface": {"type": "flat"}, "material": ALUMINIUM}}


@pytest.mark.parametrize(
    ("changes", "beyond", "place"),
    [
        ({"amplitude": "1.7 um"}, {"amplitude": "1.6 um"}, r"kinematics\.amplitude: .* 3 cells"),
        ({"amplitude": "94 um"}, {"amplitude": "95 um"}, r"kinematics\.amplitude: .* 93\.8 µm"),
        (
            {"bodies": UNLIKE, "friction": {"coefficient": 0.43}},
            {"friction": {"coefficient": 0.44}},
            r"bodies: .* 5\.1 %",
        ),
    ],
)
def test_its_limits_are_where_they_are_stated(changes, beyond, place):
    allowed = case(k=0.0, motion={"cycles": 1}, **changes)
    Simulation(allowed).run().close()
    with pytest.raises(CaseError, match=place):
        Simulation(case(k=0.0, motion={"cycles": 1}, **changes | beyond)).run()


@pytest.mark.parametrize("name", REFUSED)
def test_what_partial_slip_is_not_for_is_refused_in_one_line(name):
    changes, words = REFUSED[name]
    wrong = {key: value for key, value in case(**changes).items() if value is not None}
    with pytest.raises(CaseError, match=words) as caught:
        Simulation(wrong).run()
    assert len(str(caught.value).splitlines()) == 1


def test_a_check_finds_a_narrow_ring():
    with pytest.raises(CaseError, match=r"kinematics\.amplitude: "):
        check_case(Case.model_validate(case(amplitude="1 um")))
