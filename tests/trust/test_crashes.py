"""A crash before any file operation costs no acknowledged save, and no bit."""

import copy
import shutil
from functools import partial

import numpy as np
import pytest
import sweeps
from command_line import tribo
from made_results import quick_reports
from paper_models import half_space, motion, pair, small
from strangers.debris import Debris
from strangers.running_in import RunningIn
from trust.crashes import contents_of, of_each_kind, recorded
from trust.trial import contents, same

import tribo.simulation.run as tribo_run
from tribo import CaseError, Grid, Result, Simulation, sweep
from tribo.config.write import to_toml
from tribo.observers.observer import Observer
from tribo.observers.recorder import Recorder
from tribo.stepping.explicit import Explicit

# Of few cells, and of a checkpoint that was not whole.
pytestmark = pytest.mark.filterwarnings("ignore::tribo.TriboWarning")

ARCHARD = {"type": "archard", "k": 3e-16}
STEEL = {"young": "207 GPa", "poisson": 0.3, "hardness": "1.5 GPa"}
STEEL |= {"density": 7850, "conductivity": 46, "heat_capacity": 460}
BODY = {"material": STEEL, "wear": ARCHARD}
CASE = {
    "grid": {"size": "0.7 mm", "cells": 8},
    "contact": {"type": "dcfft"},
    "load": "100 N",
    "friction": 0.2,
    "bodies": {
        "ball": {"surface": {"type": "sphere", "radius": "5 mm"}, **BODY},
        "disk": {"surface": {"type": "flat"}, **BODY},
    },
    "kinematics": {"type": "reciprocating", "stroke": "2 mm", "frequency": 25, "duration": 1},
    "stepping": {"type": "explicit", "time_step": 0.5},
    "output": {"save_times": [0.5]},
}
CASE["kinematics"]["positions"] = "average"
MODIFIED = {"law": ARCHARD, "factor": 6}
MODELS = {
    "running_in": {"type": "running_in", "over": "0.1 GPa m", **MODIFIED},
    "smoothing": {"type": "smoothing", "roughness": "0.4 um", "settled": "0.1 um", **MODIFIED},
    "energy.dissipation": {"type": "energy.dissipation", "alpha": "3e-6 mm^3/J"},
    "roughening.detachment": {"type": "roughening.detachment", "diameter": "400 um", "k": 3e-16},
    "thirdbody.debris": {"type": "thirdbody.debris", "ejection_length": "0.5 m"},
    "thermal.flash": {"type": "thermal.flash", "ambient": "20 degC"},
    "layers": [{"thickness": "0.05 um", "wear": {"type": "archard", "k": 1e-16}}],
    "positions": {},
}
MODELS["smoothing"]["depth"] = "0.1 um"
MODELS["roughening.detachment"]["thickness"] = "0.05 um"
MODELS["thirdbody.debris"]["cover"] = "1 um"
MODELS["thermal.flash"]["heat_paths"] = {"ball": {"length": 0.01, "area": 1e-4, "capacity": 1.0}}


def with_model(name):
    """A case of a few steps with a model that keeps a state."""
    case, model = copy.deepcopy(CASE), MODELS[name]
    if name in ("layers", "positions"):
        # Their steps remember those before.
        case["stepping"] = {"type": "implicit", "depth_tolerance": 0.1, "pressure_tolerance": 1}
    if name == "layers":
        case["bodies"]["ball"]["layers"] = model
    elif name == "positions":
        case["kinematics"] |= {"stroke": "0.2 mm", "positions": 9}
    elif name in ("thirdbody.debris", "thermal.flash"):
        case["effects"] = [model]
    else:
        on = ("ball",) if name == "roughening.detachment" else ("ball", "disk")
        for body in on:
            case["bodies"][body]["wear"] = model
        if name == "energy.dissipation":
            case["effects"] = ["energy.friction_traction"]
    return Simulation(case)


def everything():
    """A case whose laws and effect remember and whose disk yields."""
    law = RunningIn(k_first=9e-16, k_last=3e-16, length=5.0)
    model = small(
        grid=Grid((0.7e-3, 0.7e-3), (8, 8)),
        contact=half_space(),
        bodies=pair(law, law, (None, 1.5e9)),
        kinematics=motion(duration=2),
        stepping=Explicit(time_step=1),
        effects=[Debris(length=0.5)],
    )
    return Simulation(model.case)


class Acknowledge(Observer):
    """Tells of each save once the recorder has it."""

    tell: object

    def on_save(self, snapshot):
        self.tell()


def resumed_from_each(crashes, simulation, folder, undisturbed):
    """Resume from what each crash left; return how many could be, and how many had no save.

    Of these every fifth is run again.
    """
    path, resumed, refused = folder / "run.h5", 0, 0
    for crash in crashes:
        crash.lay(folder)
        try:
            if crash.acknowledged:
                with Result.open(path) as result:
                    assert len(result.times) >= crash.acknowledged, crash
            simulation.resume(path).close()
            resumed += 1
        except CaseError as error:
            # It had nothing saved, or all.
            if "is done; there is nothing" not in str(error):
                if crash.acknowledged:
                    raise
                refused += 1
                if refused % 5:
                    continue
                simulation.run(path, overwrite=True).close()
        assert same(contents(path), undisturbed), f"{crash.how} before {crash.at}"
        assert [each.name for each in folder.iterdir()] == ["run.h5"]
    return resumed, refused


def ran(simulation, folder):
    """Run in a new folder; return its operations with the result that nothing disturbed."""
    folder.mkdir()
    with recorded(folder) as work:
        saves = Acknowledge(tell=work.acknowledge)
        simulation.run(folder / "run.h5", observers=[saves]).close()
    return work, contents(folder / "run.h5")


def test_a_run_goes_on_to_the_same_bits_from_a_crash_before_each_file_operation(
    tmp_path, monkeypatch
):
    # A checkpoint at every step, and those of saves.
    monkeypatch.setattr(tribo_run, "Recorder", partial(Recorder, checkpoint_every=0.0))
    simulation, folder = everything(), tmp_path / "run"
    work, undisturbed = ran(simulation, folder)
    crashes = of_each_kind(work.crashes())
    resumed, refused = resumed_from_each(crashes, simulation, folder, undisturbed)
    # Before the first checkpoint there is nothing to go on from; the last one is done.
    assert len(crashes) == resumed + refused + 1
    assert resumed > 15 > refused


def test_what_goes_on_goes_on_again_from_a_crash_before_each_of_its_file_operations(tmp_path):
    simulation, folder = everything(), tmp_path / "run"
    work, undisturbed = ran(simulation, folder)
    last = [crash for crash in work.crashes() if crash.acknowledged == 1][-1]
    last.lay(folder)
    with recorded(folder) as again:
        again.acknowledge()
        saves = Acknowledge(tell=again.acknowledge)
        simulation.resume(folder / "run.h5", observers=[saves]).close()
    crashes = of_each_kind(again.crashes()[1:])
    resumed, refused = resumed_from_each(crashes, simulation, folder, undisturbed)
    assert (resumed, refused) == (len(crashes) - 1, 0)


@pytest.mark.parametrize("name", MODELS)
def test_a_model_that_keeps_a_state_goes_on_to_the_same_bits_from_each_checkpoint(tmp_path, name):
    simulation, folder = with_model(name), tmp_path / "run"
    work, undisturbed = ran(simulation, folder)
    files = "run.h5.run/checkpoint", "run.h5.run/checkpoint.previous"
    checkpoints = {
        crash.files[files[0]]: crash for crash in work.crashes() if {*files} <= crash.files.keys()
    }
    resumed, _ = resumed_from_each(checkpoints.values(), simulation, folder, undisturbed)
    assert resumed == 2
    model = simulation.model
    states = [field for place in (*model.case.bodies, None) for field in model.laws.kept_on(place)]
    assert bool(states) == (name not in ("layers", "positions"))


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A folder with a case, its result, what was weighed, and a map of a scar."""
    folder = tmp_path_factory.mktemp("made") / "made"
    folder.mkdir()
    (folder / "run.toml").write_text(to_toml(CASE))
    weighed = {"body": "ball", "quantity": "mass", "value": "0.5 ug", "uncertainty": "5 %"}
    (folder / "weighed.toml").write_text(to_toml({"measured": [weighed]}))
    far = np.hypot(*Grid((0.7e-3, 0.7e-3), (48, 48)).mesh)
    noise = 1e-8 * np.random.default_rng(0).standard_normal(far.shape)
    np.save(folder / "scar.npy", noise - np.maximum(1e-6 - 40 * far**2, 0))
    with_model("running_in").run(folder / "run.h5").close()
    return folder


def compared(folder):
    done = tribo("compare", "run.toml", "--vary", "load=50 N,60 N", "--no-plots", cwd=folder)
    assert done.returncode == 0, done.stderr


def swept(folder):
    study = 'case = "run.toml"\n[grid]\nload.normal = ["50 N"]\n'
    (folder / "study.toml").write_text(study)
    sweep(folder / "study.toml", executor=sweeps.Inline())


@pytest.mark.parametrize("runs", [compared, swept])
def test_runs_side_by_side_end_alike_from_a_crash_before_each_file_operation(made, tmp_path, runs):
    folder = tmp_path / "work"
    shutil.copytree(made, folder)
    with recorded(folder) as work:
        runs(folder)
    after = contents_of(folder)
    results = {name: contents(folder / name) for name in after if name.endswith(".h5")}
    assert len(results) == (3 if runs is compared else 2)
    # What a crash leaves of one run alone is tried above.
    crashes = {
        frozenset(n for n in crash.files if ".run/" not in n and not n.endswith(".new")): crash
        for crash in work.crashes()
    }
    for crash in of_each_kind(crashes.values()):
        crash.lay(folder)
        runs(folder)
        left = contents_of(folder).keys() ^ after.keys()
        # Of a run killed just as it ended the folder stays, of a file that was not whole its part.
        assert all(".h5.run" in name or name.endswith((".lock", ".new")) for name in left), left
        for name, result in results.items():
            assert same(contents(folder / name), result), f"{crash.how} before {crash.at}"


COMMANDS = {
    "export": ("export", "run.h5"),
    "plot": ("plot", "run.h5"),
    "report": ("report", "run.h5"),
    "new": ("new", "ball_on_flat", "mine.toml"),
    "plugins new": ("plugins", "new", "acme-law", "--kind", "wear-law"),
    "calibrate": ("calibrate", "run.toml", "--measured", "weighed.toml", "-o", "fitted.toml"),
    "scar": ("scar", "scar.npy", "--ideal", "flat", "--pitch", "14.6 um", "-o", "a.png"),
}


@pytest.mark.parametrize("command", COMMANDS.values(), ids=COMMANDS)
def test_a_command_leaves_whole_files_at_a_crash_before_each_operation(
    made, tmp_path, monkeypatch, command
):
    quick_reports(monkeypatch)
    folder = tmp_path / "work"
    shutil.copytree(made, folder)
    with recorded(folder) as work:
        done = tribo(*command, cwd=folder)
    assert done.returncode == 0, done.stderr
    after = contents_of(folder)
    crashes = work.crashes()
    assert len(crashes) > 4
    for crash in crashes:
        for name, held in crash.files.items():
            if not name.endswith(".new"):
                assert held in (work.before.get(name, b"\0"), after[name]), (crash.how, name)
    assert crashes[-1].files == after
    assert not any(name.endswith(".new") for name in after)
