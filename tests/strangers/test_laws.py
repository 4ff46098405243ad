"""A stranger's law is short, and gets everything else for nothing."""

import ast
import inspect

import numpy as np
import pytest
from strangers import laws
from strangers.oxidation import OxideFilm
from strangers.protected import Protected
from strangers.running_in import RunningIn
from strangers.transition import Transition

from tribo import CaseError, Registry, Simulation
from tribo.case import Case
from tribo.config.load import validate_case
from tribo.config.schema import json_schema

CONFIGS = {
    Protected: {"k": "1e-15 1/Pa"},
    RunningIn: {"k_first": "4e-15 1/Pa", "k_last": "1e-15 1/Pa", "length": "2 m"},
    Transition: {"k": "1e-15 1/Pa", "p_severe": "400 MPa"},
}
STEEL = {"young": "207 GPa", "poisson": 0.3}
EFFECTS = [{"type": "stranger.oxide_film", "power": "50 MW/m^2"}]
LAWS = pytest.mark.parametrize("law", CONFIGS, ids=lambda law: law.type)


@pytest.fixture(scope="module")
def registry():
    return Registry.with_plugins(laws)


def case(law, **changes):
    wear = {"type": law.type, **CONFIGS[law]}
    return {
        "grid": {"size": "0.7 mm", "cells": 32},
        "load": {"normal": "20 N"},
        "bodies": {
            "ball": {
                "surface": {"type": "sphere", "radius": "5 mm"},
                "material": STEEL,
                "wear": wear,
            },
            "disk": {"surface": {"type": "flat"}, "material": STEEL, "wear": wear},
        },
        "kinematics": {
            "type": "reciprocating",
            "stroke": "4 mm",
            "frequency": "12.5 Hz",
            "duration": "60 s",
        },
        "friction": {"coefficient": 0.4},
        "effects": EFFECTS if law.requires else [],
        **changes,
    }


def own_lines(module):
    """Lines of code: neither blank, nor comments, nor docstrings."""
    source = inspect.getsource(module)
    said = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            said |= set(range(node.lineno, (node.end_lineno or node.lineno) + 1))
    lines = enumerate(source.splitlines(), start=1)
    return [s for n, s in lines if s.strip() and not s.strip().startswith("#") and n not in said]


@LAWS
def test_it_is_at_most_25_lines_imports_included(law):
    assert 5 <= len(own_lines(inspect.getmodule(law))) <= 25


@LAWS
@pytest.mark.slow
def test_it_runs_implicit_with_stroke_averaging_and_both_bodies_lose_the_same(law, registry):
    with Simulation(case(law), registry=registry).run() as result:
        end = result.saves()[-1]["bodies"]
        ball, disk = (result.body(name) for name in ("ball", "disk"))
    assert result_is_averaged(disk)
    assert not result_is_averaged(ball)
    ratio = end["disk"]["wear_volume_m3"] / end["ball"]["wear_volume_m3"]
    if law is RunningIn:
        # The disk's points slide less under pressure: they are still running in.
        assert ratio > 1.5
    else:
        assert ratio == pytest.approx(1.0, rel=1e-9)


def result_is_averaged(body):
    return bool(np.all(body.wear_depth[-1] == body.wear_depth[-1][:1]))


@pytest.mark.slow
def test_a_law_that_is_not_linear_wears_more_where_pressure_is_high(registry):
    # ∫ p (1 + (p/p_severe)²) is more than the load, by less than the first peak allows.
    with Simulation(case(Transition), registry=registry).run() as result:
        first, *_, end = result.saves()
    archard = 1e-15 * 20 * end["distance_m"]
    most = 1 + (first["max_pressure_Pa"] / 400e6) ** 2
    assert 1.1 * archard < end["bodies"]["ball"]["wear_volume_m3"] < most * archard


@pytest.mark.slow
def test_oxide_halves_the_wear_where_its_power_is_reached(registry):
    # Without bounds on the film, 1 − c tends to 1 for a power that is never reached.
    worn = []
    for power in ("1 MW/m^2", "1e15 W/m^2"):
        effects = [{"type": "stranger.oxide_film", "power": power}]
        with Simulation(case(Protected, effects=effects), registry=registry).run() as result:
            end = result.saves()[-1]
            worn.append(end["bodies"]["ball"]["wear_volume_m3"])
    assert worn[1] == pytest.approx(1e-15 * 20 * end["distance_m"], rel=1e-6, abs=0)
    assert worn[0] < 0.5 * worn[1]


def test_a_missing_effect_is_named_with_the_law_and_its_place(registry):
    with pytest.raises(CaseError) as caught:
        Simulation(case(Protected, effects=[]), registry=registry)
    message = str(caught.value)
    assert message.startswith("bodies.ball.wear: wear law 'stranger.protected' needs ")
    assert "stranger_oxide" in message
    assert "these do: 'stranger.oxide_film' (" in message
    assert "\n" not in message


def test_what_an_effect_requires_of_the_case_is_named_too(registry):
    with pytest.raises(CaseError, match=r"'stranger\.oxide_film' needs a coefficient of friction"):
        Simulation(case(Protected, friction=None), registry=registry)


@LAWS
def test_it_is_in_the_registry_and_in_the_schema(law, registry):
    name = law.type
    assert name in registry.names("wear_law")
    schema = json_schema(Case, registry)
    config = schema["$defs"][law.type]
    assert config["properties"]["type"]["const"] == name
    for key in CONFIGS[law]:
        assert config["properties"][key]["x-unit"]
        assert config["properties"][key]["description"]


@LAWS
def test_it_takes_part_in_messages(law, registry):
    def refused(old, new, value):
        tables = case(law)
        wear = {k: v for k, v in tables["bodies"]["ball"]["wear"].items() if k != old}
        wear[new] = value
        tables["bodies"]["ball"] = {**tables["bodies"]["ball"], "wear": wear}
        with pytest.raises(CaseError) as caught:
            validate_case(tables, registry=registry)
        return str(caught.value)

    name = law.type
    misspelt = refused("type", "type", name.replace("stranger.", "strnger."))
    assert f"did you mean {name!r}?" in misspelt
    assert "stranger.transition (strangers.laws 1.0)" in misspelt
    key = next(iter(CONFIGS[law]))
    wrong = refused(key, key, "5 mm")
    assert wrong.startswith(f"bodies.ball.wear.{key}: ")
    assert "an inverse pressure [1/Pa] is needed" in wrong
    assert f"did you mean '{key}'?" in refused(key, f"{key}_", 1)


@LAWS
def test_it_is_in_the_provenance(law, registry):
    short = case(law)
    short["kinematics"]["duration"] = "1 s"
    with Simulation(short, registry=registry).run() as result:
        told = result.provenance["components"]
    assert told["bodies.disk.wear"]["type"] == law.type
    assert told["bodies.disk.wear"]["class"] == f"{law.__module__}.{law.__qualname__}"
    effects = [told[place]["type"] for place in told if place.startswith("effects")]
    assert effects == ([OxideFilm.type] if law.requires else [])
