"""Laws made of another: a factor, running-in by work and by roughness."""

import numpy as np
import pytest

from tribo import (
    Archard,
    CaseError,
    Field,
    ModifiedLaw,
    Power,
    Registry,
    Simulation,
    WearRate,
    hookimpl,
)
from tribo.core.fields import LocalConditions
from tribo.core.material import Material
from tribo.wear.modified import Scaled
from tribo.wear.running_in import RunningIn, Smoothing

STEEL = Material(young="207 GPa", poisson=0.3)
K, PRESSURE = 1e-15, 40e6
ARCHARD = Archard(k=K)


def worn(law, distance, steps, pressure=PRESSURE):
    """Depth under an even pressure by the classical Runge-Kutta method: no stepping of tribo."""
    start = law.initial_state()
    state = np.array([0.0, *start.values()])

    def slope(values):
        given = {name: np.full((1, 1), v) for name, v in zip(start, values[1:], strict=True)}
        rate = law.rate(LocalConditions(np.full((1, 1), pressure), 0.1, STEEL, {}, given))
        of_state = [float(rate.state_rates[name][0, 0]) for name in start]
        return np.array([float(rate.depth_rate[0, 0]), *of_state])

    step = distance / steps
    for _ in range(steps):
        a = slope(state)
        b = slope(state + 0.5 * step * a)
        c = slope(state + 0.5 * step * b)
        state = state + step / 6 * (a + 2 * b + 2 * c + slope(state + step * c))
    return state


@pytest.mark.parametrize("pressure", [PRESSURE, 3 * PRESSURE])
def test_running_in_costs_the_same_depth_under_any_pressure(pressure):
    law = RunningIn(law=ARCHARD, factor=6, over="0.2 GPa m")
    depth, work = worn(law, 20.0, 200, pressure)
    fresh = 1 - np.exp(-pressure * 20 / 0.2e9)
    assert depth == pytest.approx(K * pressure * 20 + 5 * K * 0.2e9 * fresh, rel=1e-6)
    assert work == pytest.approx(20 * pressure)


def test_smoothing_is_its_closed_form():
    law = Smoothing(law=ARCHARD, factor=6, roughness="0.4 um", settled="0.1 um", depth="0.3 um")
    depth, left = worn(law, 20.0, 200)
    exact = 0.3e-6 * np.log(1 + 6 * (np.exp(K * PRESSURE * 20 / 0.3e-6) - 1))
    assert depth == pytest.approx(exact, rel=1e-6)
    assert left == pytest.approx(0.1e-6 + 0.3e-6 * np.exp(-exact / 0.3e-6), rel=1e-6, abs=0)
    late = worn(law, 200.0, 2000)[0]
    assert late - K * PRESSURE * 200 == pytest.approx(0.3e-6 * np.log(6), rel=1e-4)


def test_a_surface_smoother_than_it_settles_at_is_refused():
    with pytest.raises(CaseError, match="settled must be less than roughness"):
        Smoothing(law=ARCHARD, factor=2, roughness="0.1 um", settled="0.1 um", depth="1 um")


class Tired(ModifiedLaw):
    """A stranger's: wear halves where the surface is oxidised, and grows with each metre."""

    type = "stranger.tired"
    own_requires = ("friction_coefficient", "stranger_oxide")
    own_state = (Field("slid", "m", "Distance slid."),)

    def rate(self, local):
        rate = self.law.rate(local)
        more = 1 + local.state["slid"]
        slid = {"slid": (local.pressure > 0).astype(float)}
        return WearRate(more * rate.depth_rate, more * rate.depth_slope, rate.state_rates | slid)


class Fussy(Archard):
    """A law that refuses materials and cells."""

    type = "stranger.fussy"

    def check(self, material):
        raise CaseError("no such material")

    def check_cells(self, spacing):
        raise CaseError("no such cells")


def test_it_needs_keeps_and_refuses_what_either_does():
    inner = RunningIn(law=Tired(law=ARCHARD), factor=2, over=1e9)
    law = Scaled(law=inner, factor=0.5)
    assert law.requires == ("friction_coefficient", "stranger_oxide")
    assert [field.name for field in law.state_fields] == ["slid", "pressure_distance"]
    assert law.initial_state() == {"slid": 0.0, "pressure_distance": 0.0}
    fussy = Scaled(law=Fussy(k=K), factor=1)
    with pytest.raises(CaseError, match="no such material"):
        fussy.check(STEEL)
    with pytest.raises(CaseError, match="no such cells"):
        fussy.check_cells((1e-6, 1e-6))


def test_two_laws_that_keep_the_same_field_are_refused():
    twice = {"type": "running_in", "factor": 2, "over": 1e9}
    with pytest.raises(ValueError, match="'pressure_distance' is declared twice"):
        RunningIn.model_validate({**twice, "law": {**twice, "law": ARCHARD}})


class Offered:
    @staticmethod
    @hookimpl
    def tribo_components():
        return [Tired]


def case(law):
    steel = {"young": "207 GPa", "poisson": 0.3}
    pin = {"surface": "flat", "material": steel, "wear": law}
    return {
        "grid": {"size": "2 mm", "cells": 8, "ends_at_window": True},
        "load": "40 N",
        "bodies": {"pin": pin, "disk": {"surface": "flat", "material": steel}},
        "contact": {"type": "winkler", "modulus": 1e15},
        "kinematics": {
            "type": "unidirectional",
            "speed": "0.1 m/s",
            "track_length": "20 mm",
            "distance": "1 m",
        },
    }


def test_what_is_wrong_inside_is_told_with_its_place():
    wrong = {"type": "scaled", "factor": 2, "law": {"type": "archard", "k": "1e-15 m"}}
    with pytest.raises(CaseError, match=r"^bodies\.pin\.wear\.law\.k: "):
        Simulation(case(wrong))
    with pytest.raises(CaseError, match=r"^bodies\.pin\.wear\.law\.type: .*'archad'"):
        Simulation(case({**wrong, "law": {"type": "archad"}}))
    tired = {"type": "scaled", "factor": 2, "law": {"type": "stranger.tired", "law": ARCHARD}}
    with pytest.raises(CaseError, match=r"pin\.wear: .* needs the field friction_.*stranger_oxide"):
        Simulation(case(tired), registry=Registry.with_plugins(Offered))


def test_a_scaled_law_is_the_law_scaled_and_named_in_the_result():
    power = {"k": K, "p_exponent": 2, "reference_pressure": PRESSURE}
    scaled = Scaled(factor=0.25, law=Power(**power))
    plain = Power(**{**power, "k": 0.25 * K})
    depths = []
    for law in (scaled, plain):
        with Simulation(case(law)).run() as result:
            depths.append(result.body("pin").wear_depth[-1])
            components = result.provenance["components"]
    np.testing.assert_array_equal(*depths)
    with Simulation(case(scaled)).run() as result:
        components = result.provenance["components"]
    assert components["bodies.pin.wear.law"]["type"] == "power"
    assert components["bodies.pin.wear.law"]["distribution"] == "tribo"
