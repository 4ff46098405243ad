"""The energy law in runs of the whole program: implicit steps, stroke averages."""

import copy
import runpy
import tomllib
from pathlib import Path

import numpy as np
import pytest
from tribo import CaseError, Observer, Simulation
from tribo.lab.report import lab_report

from tribo_energy.plugin import EXAMPLE, tribo_figures

HERE = Path(__file__).parent
ALPHA, MU, LOAD = 3.11e-15, 0.1, 100.0


class Last(Observer):
    type = "test.last"

    _seen: object = None

    def on_step(self, snapshot):
        self._seen = snapshot

    @property
    def state(self):
        return self._seen.state

    @property
    def measures(self):
        return self._seen.measures


def case(duration=100, cells=24, **wear):
    data = tomllib.loads(EXAMPLE.read_text())
    data["grid"] = {"size": "0.8 mm", "cells": cells}
    data["kinematics"]["duration"] = duration
    data["output"] = {}
    for body in data["bodies"].values():
        body["wear"].update(wear)
    return data


def run(data):
    simulation, last = Simulation(data), Last()
    result = simulation.run(observers=[last])
    return simulation.model, last, result


@pytest.fixture(scope="module")
def energy():
    return run(case())


def test_with_alpha_k_over_mu_it_is_archard(energy):
    data = case()
    del data["effects"]
    for body in data["bodies"].values():
        body["wear"] = {"type": "archard", "k": ALPHA * MU}
    _, archard, _ = run(data)
    ours = energy[1].state
    # k p and α (μ p) round differently; nothing else differs, and the same steps are taken.
    assert ours.steps == archard.state.steps
    assert ours.contact_solves == archard.state.contact_solves
    for name, body in archard.state.bodies.items():
        np.testing.assert_allclose(
            ours.bodies[name].wear, body.wear, rtol=1e-11, atol=1e-13 * body.wear.max()
        )


def test_each_body_sees_all_the_energy_of_friction(energy):
    model, last, _ = energy
    for name, body in last.state.bodies.items():
        total = model.cycle.maps[name].volume(body.law["dissipated_energy"])
        assert total == pytest.approx(MU * LOAD * last.state.distance, rel=1e-10)


@pytest.mark.parametrize(
    ("without", "needs"),
    [("effects", "friction_traction"), ("friction", "coefficient of friction")],
)
def test_a_case_without_friction_is_refused(without, needs):
    data = copy.deepcopy(case())
    del data[without]
    with pytest.raises(CaseError, match=needs):
        Simulation(data)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:averaging:tribo.TriboWarning")
def test_the_readme_shows_what_the_example_prints(capsys):
    runpy.run_path(str(HERE.parent / "examples" / "compare_with_archard.py"), run_name="__main__")
    printed = capsys.readouterr().out.rstrip()
    archard, energy, half = (line.split(":")[1] for line in printed.splitlines())
    assert archard == energy != half
    assert printed in (HERE.parent / "README.md").read_text()


def test_the_lab_is_told_the_energy_and_the_volume_it_wore():
    data = tomllib.loads(EXAMPLE.read_text())
    data["kinematics"]["duration"], data["output"] = 50, {}
    with Simulation(data).run() as result:
        energy, volume = lab_report(result).rows
        (draw,) = tribo_figures(result).values()
        (axes,) = draw().axes
    assert axes.get_xlabel() == "Dissipated energy (J)"
    assert [line.get_linestyle() for line in axes.lines] == ["-", "--"]
    # Two bodies, each V = α Σ E.
    assert energy.value == pytest.approx(MU * LOAD * 2 * 2e-3 * 25 * 50, rel=1e-9, abs=0)
    assert volume.value == pytest.approx(2 * ALPHA, rel=1e-9, abs=0)
