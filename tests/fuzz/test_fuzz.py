"""A few of the fuzzed cases; the long run of them is a command."""

import os
import random
import sys
import time
import tomllib
from dataclasses import replace

import command_line
import pytest
from fuzz import fuzzing, trial
from fuzz.generate import mutated, plausible, toml, valid_cases
from fuzz.trial import schema
from paper_models import case, motion

from tribo import CaseError, Result, Simulation
from tribo.config.load import validate_case


@pytest.mark.slow
def test_some_cases_of_each_kind_end_as_they_should():
    done = fuzzing.fuzz(2 * len(trial.KINDS), seed=3, workers=1)
    assert done.faults == {}
    # Those that were stopped on a busy machine, with 130, are counted apart.
    codes = done.figures()["exit codes"]
    assert codes["0"] > 1
    assert codes["2"] > 5


def test_what_to_install_is_said_before_anything_starts(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "SurfaceTopography", None)
    monkeypatch.setattr(sys, "argv", ["command"])
    with pytest.raises(SystemExit):
        fuzzing.main()
    said = capsys.readouterr()
    assert said.out == ""
    assert "SurfaceTopography is not installed" in said.err
    assert "pip install -r requirements-dev.txt" in said.err


def test_a_case_is_repeatable():
    chances = [random.Random("1/7") for _ in range(2)]
    first, second = (mutated(valid_cases()[0], schema(), chance) for chance in chances)
    assert toml(first) == toml(second)


def test_what_is_written_is_what_was_made():
    chance = random.Random(1)
    for _ in range(50):
        case = plausible(chance.choice(valid_cases()), chance)
        assert tomllib.loads(toml(case)) == case


def test_half_of_the_plausible_cases_are_valid():
    chance, valid = random.Random(1), 0
    for _ in range(100):
        try:
            validate_case(plausible(chance.choice(valid_cases()), chance))
        except CaseError:
            continue
        valid += 1
    assert valid > 50


@pytest.mark.parametrize(
    ("end", "words"), [(lambda *_: time.sleep(60), "hang"), (lambda *_: os._exit(1), "death")]
)
@pytest.mark.slow
def test_a_hang_and_a_death_are_seen(monkeypatch, end, words):
    monkeypatch.setattr(trial, "_schema", end)
    monkeypatch.setattr(fuzzing, "HANG", 1.0)
    monkeypatch.setattr(fuzzing, "START", "fork")
    monkeypatch.setattr(trial, "prepare", os.chdir)
    figures = fuzzing.fuzz(0, seed=1, workers=1, numbers=[0]).figures()
    assert figures["hangs" if words == "hang" else "deaths"] == figures["faults"] == 1


@pytest.mark.parametrize(
    ("end", "words"),
    [
        (lambda: 1 / 0, "traceback: ZeroDivisionError"),
        (lambda: sys.exit(1), "exit code 1"),
        (lambda: sys.exit(2), "no message"),
        (lambda: print("Traceback", file=sys.stderr), "traceback"),
    ],
)
def test_an_end_that_is_not_documented_is_seen(monkeypatch, tmp_path, end, words):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(command_line, "main", end)
    _, fault, _ = trial.timed(trial.KINDS.index("text"), 1)
    assert fault.startswith(words)


@pytest.mark.parametrize(
    ("name", "wrong", "words"),
    [
        ("status", property(lambda self: "running"), "status 'running' after success"),
        (
            "field",
            lambda self, *at: field(self, *at) * (1.01 if at[0] == "pressure" else 1),
            "the pressure of save 0",
        ),
        ("worst", lambda self: {**worst(self), "volume_error": 1e-3}, "volume_error is 0.001"),
        ("worst", lambda self: {**worst(self), "force_error": float("nan")}, "force_error is nan"),
        ("body", lambda self, name: grown_back(body(self, name)), "ball grows back"),
    ],
)
def test_a_result_that_cannot_be_is_seen(monkeypatch, tmp_path, name, wrong, words):
    path = tmp_path / "run.h5"
    Simulation(case(kinematics=motion(duration=5))).run(path).close()
    assert trial.broken(path, 0) is None
    monkeypatch.setattr(Result, name, wrong)
    assert trial.broken(path, 0).startswith(words)


field, worst, body = Result.field, Result.worst, Result.body


def grown_back(kept):
    return replace(kept, wear_depth=kept.wear_depth[::-1])


def test_a_fuzz_that_was_stopped_is_not_good():
    assert fuzzing.Fuzz().good
    assert not fuzzing.Fuzz(stopped=True).good
    assert not fuzzing.Fuzz(faults={1: "hang"}).good
