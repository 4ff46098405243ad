"""A crash before any file operation costs no acknowledged save, and no bit."""

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
from tribo import CaseError, Grid, Implicit, Result, Simulation, sweep
from tribo.core.toml import to_toml
from tribo.observers.observer import Observer
from tribo.observers.recorder import Recorder
from tribo.stepping.explicit import Explicit

# Of few cells, and of a checkpoint that was not whole.
pytestmark = pytest.mark.filterwarnings("ignore::tribo.TriboWarning")

LAW = RunningIn(k_first=9e-16, k_last=3e-16, length=5.0)
WINDOW = Grid((0.7e-3, 0.7e-3), (8, 8))


def averaged():
    """A case in explicit steps whose laws and effect remember and whose disk yields."""
    model = small(
        grid=WINDOW,
        contact=half_space(),
        bodies=pair(LAW, LAW, (None, 1.5e9)),
        kinematics=motion(duration=2),
        stepping=Explicit(time_step=1),
        effects=[Debris(length=0.5)],
    )
    return Simulation(model.case)


def resolved():
    """A case in implicit steps, which remember those before, of a cycle of positions."""
    model = small(
        grid=WINDOW,
        bodies=pair(LAW, LAW),
        kinematics=motion(duration=1, stroke=0.2e-3, positions=9),
        stepping=Implicit(depth_tolerance=0.1, pressure_tolerance=1),
        save_times=(0.5,),
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
    simulation, folder = averaged(), tmp_path / "run"
    work, undisturbed = ran(simulation, folder)
    crashes = of_each_kind(work.crashes())
    resumed, refused = resumed_from_each(crashes, simulation, folder, undisturbed)
    # Before the first checkpoint there is nothing to go on from; the last one is done.
    assert len(crashes) == resumed + refused + 1
    assert resumed > 15 > refused


def test_what_goes_on_goes_on_again_from_a_crash_before_each_of_its_file_operations(tmp_path):
    simulation, folder = averaged(), tmp_path / "run"
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


def test_steps_that_remember_go_on_to_the_same_bits_from_each_checkpoint(tmp_path):
    simulation, folder = resolved(), tmp_path / "run"
    work, undisturbed = ran(simulation, folder)
    files = "run.h5.run/checkpoint", "run.h5.run/checkpoint.previous"
    checkpoints = {
        crash.files[files[0]]: crash for crash in work.crashes() if {*files} <= crash.files.keys()
    }
    resumed, _ = resumed_from_each(checkpoints.values(), simulation, folder, undisturbed)
    assert resumed == 2


CASE = """
load = "100 N"
grid = { size = "0.7 mm", cells = 8 }
contact.type = "dcfft"
kinematics = { type = "reciprocating", stroke = "2 mm", frequency = 25, duration = 1 }
stepping = { type = "explicit", time_step = 0.5 }

[bodies.ball]
surface = { type = "sphere", radius = "5 mm" }
material = { young = "207 GPa", poisson = 0.3 }
wear = { type = "archard", k = 3e-16 }

[bodies.disk]
surface = { type = "flat" }
material = { young = "207 GPa", poisson = 0.3 }
"""


def compared(folder):
    done = tribo("compare", "run.toml", "--vary", "load=50 N,60 N", "--no-plots", cwd=folder)
    assert done.returncode == 0, done.stderr


def swept(folder):
    study = 'case = "run.toml"\n[grid]\nload.normal = ["50 N"]\n'
    (folder / "study.toml").write_text(study)
    sweep(folder / "study.toml", executor=sweeps.Inline())


@pytest.mark.parametrize("runs", [compared, swept])
def test_runs_side_by_side_end_alike_from_a_crash_before_each_file_operation(tmp_path, runs):
    folder = tmp_path / "work"
    folder.mkdir()
    (folder / "run.toml").write_text(CASE)
    with recorded(folder) as work:
        runs(folder)
    after = contents_of(folder)
    results = {name: contents(folder / name) for name in after if name.endswith(".h5")}
    assert len(results) == (2 if runs is compared else 1)
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


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A folder with a case, its result, what was weighed, and a map of a scar."""
    folder = tmp_path_factory.mktemp("made") / "made"
    folder.mkdir()
    (folder / "run.toml").write_text(CASE)
    weighed = {"body": "ball", "quantity": "volume", "value": "1e-4 mm^3", "uncertainty": "5 %"}
    (folder / "weighed.toml").write_text(to_toml({"measured": [weighed]}))
    far = np.hypot(*Grid((0.7e-3, 0.7e-3), (48, 48)).mesh)
    noise = 1e-8 * np.random.default_rng(0).standard_normal(far.shape)
    np.save(folder / "scar.npy", noise - np.maximum(1e-6 - 40 * far**2, 0))
    averaged().run(folder / "run.h5").close()
    return folder


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
