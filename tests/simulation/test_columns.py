"""Models and observers add numbers to each step."""

import json

import numpy as np
import pytest
from command_line import tribo
from edited import bits
from paper_models import K, StopAfter

from tribo import (
    CaseError,
    Column,
    Finding,
    Interrupted,
    NumericalError,
    Observer,
    Registry,
    Result,
    Simulation,
    WearLaw,
    WearRate,
    hookimpl,
)


def mean_pressure(snapshot, body):
    assert body == "ball"
    pressure = snapshot.state.contact.pressure
    return pressure[pressure > 0].mean()


class Pressed(WearLaw):
    """Archard's law, which reads the mean pressure on its body."""

    type = "acme.pressed"
    columns = (Column("mean_pressure", "Pa", "Mean.", mean_pressure, of_bodies=True),)

    def rate(self, local):
        return WearRate(K * local.pressure)


class Mileage(Observer):
    """Counts sliding in strokes, and ends the run after some."""

    type = "acme.mileage"
    most: float = 1000.0
    fails: bool = False

    @property
    def columns(self):
        def strokes(snapshot):
            if self.fails and snapshot.measures.distance > 0:
                raise ZeroDivisionError
            return snapshot.measures.distance / 2e-3

        return [Column("strokes", "1", "Strokes so far", strokes)]

    def findings(self, snapshot):
        strokes = snapshot.columns["strokes"]
        return [Finding("stop", "enough", strokes, limit=self.most)] * (strokes >= self.most)


class Acme:
    """What a package offers."""

    @hookimpl
    def tribo_components(self):
        return [Pressed, Mileage]


def case(**mileage):
    steel = {"young": "207 GPa", "poisson": 0.3}
    sphere = {"type": "sphere", "radius": "5 mm"}
    ball = {"surface": sphere, "material": steel, "wear": "acme.pressed"}
    motion = {"type": "reciprocating", "stroke": "2 mm", "frequency": 25, "duration": 3.0}
    return {
        "bodies": {"ball": ball, "disk": {"surface": "flat", "material": steel}},
        "load": {"normal": 100},
        "grid": {"size": "0.7 mm", "cells": 24},
        "contact": {"type": "winkler", "modulus": 1.3e15},
        "kinematics": {**motion, "swept": "disk", "positions": "average"},
        "observers": [{"type": "acme.mileage", **mileage}],
        "output": {"save_times": [1.0]},
    }


def simulation(given=None):
    return Simulation(given or case(), Registry.with_plugins(Acme()))


def test_columns_of_a_law_and_an_observer_stand_in_every_table(tmp_path):
    path = tmp_path / "run.h5"
    simulation().run(path).close()
    with Result.open(path) as result:
        for name in ("history", "saves"):
            table = result.table(name)
            assert table["strokes"] == pytest.approx(table["distance_m"] / 2e-3, rel=1e-9, abs=1e-9)
            mean = table["load_N"] / table["contact_area_m2"]
            assert table["bodies.ball.mean_pressure_Pa"] == pytest.approx(mean)
            # The disk has no such law.
            assert "bodies.disk.mean_pressure_Pa" not in table
        assert result.strokes.attrs["units"] == "1"
        assert result.mean_pressure.attrs["long_name"] == "Mean."
        last = result.saves()[-1]
    shown = json.loads(tribo("show", str(path), "--json").stdout)
    assert shown["saves"][-1]["strokes"] == last["strokes"]
    body = shown["saves"][-1]["bodies"]["ball"]
    assert body["mean_pressure_Pa"] == last["bodies"]["ball"]["mean_pressure_Pa"]
    assert tribo("export", str(path), "-d", str(tmp_path)).returncode == 0
    for name in ("history", "saves"):
        rows = np.genfromtxt(tmp_path / f"{name}.csv", delimiter=",", names=True)
        assert rows["strokes"][-1] == pytest.approx(last["strokes"])


def test_a_finding_may_follow_from_a_column():
    with simulation(case(most=100.0)).run() as result:
        (finding,) = [each for each in result.findings if each.kind == "stop"]
        strokes = result.table("history")["strokes"]
    assert strokes[-2] < 100.0 <= strokes[-1] == finding.value


def test_a_run_with_columns_resumes_to_the_same_bits_and_with_the_same_columns(tmp_path):
    path = tmp_path / "run.h5"
    with pytest.raises(Interrupted):
        simulation(case(most=100.0)).run(path, observers=[StopAfter(steps=4)])
    with pytest.raises(CaseError, match="strokes"):
        simulation({**case(most=100.0), "observers": []}).resume(path, allow_changed=True)
    with simulation(case(most=100.0)).resume(path) as result:
        resumed = bits(result)
    with simulation(case(most=100.0)).run() as result:
        assert bits(result) == resumed


class Twice(Observer):
    """Has a column of the other observer's name."""

    columns = (Column("strokes", "1", "Strokes", lambda snapshot: 0.0),)


class Load(Observer):
    """Has a column that every result has."""

    columns = (Column("load", "N", "Load", lambda snapshot: 0.0),)


@pytest.mark.parametrize("other", [Twice(), Load()])
def test_a_name_that_is_taken_is_refused(other):
    with pytest.raises(CaseError, match=f"observer '{other.type}'"):
        simulation().run(observers=[other])


def test_a_column_that_cannot_be_read_names_its_model():
    with pytest.raises(NumericalError, match=r"acme\.mileage.*ZeroDivisionError"):
        simulation(case(fails=True)).run()
