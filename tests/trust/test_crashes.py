"""A crash before any file operation costs no acknowledged save, and no bit."""

from functools import partial

import pytest
import sweeps
from command_line import tribo
from paper_models import case, motion, pair
from trust.crashes import contents_of, of_each_kind, recorded
from trust.trial import LAW, Acknowledge, contents, same, simulation

import tribo.simulation.run as tribo_run
from tribo import CaseError, Grid, Implicit, Result, sweep
from tribo.core.toml import to_toml
from tribo.observers.recorder import Recorder
from tribo.stepping.explicit import Explicit

# Of few cells, and of a checkpoint that was not whole.
pytestmark = pytest.mark.filterwarnings("ignore::tribo.TriboWarning")

WINDOW = Grid((0.7e-3, 0.7e-3), (8, 8))


def averaged():
    """A case in explicit steps whose laws and effect remember and whose disk yields."""
    return simulation(
        grid=WINDOW,
        bodies=pair(LAW, LAW, (None, 1.5e9)),
        kinematics=motion(duration=2),
        stepping=Explicit(time_step=1),
        save_times=(),
    )


def resolved():
    """A case in implicit steps, which remember those before, of a cycle of positions."""
    return simulation(
        grid=WINDOW,
        kinematics=motion(duration=1, stroke=0.2e-3, positions=9),
        stepping=Implicit(depth_tolerance=0.1, pressure_tolerance=1),
        effects=[],
        save_times=(0.5,),
    )


def resumed_from_each(crashes, case, folder, undisturbed):
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
            case.resume(path).close()
            resumed += 1
        except CaseError as error:
            # It had nothing saved, or all.
            if "is done; there is nothing" not in str(error):
                if crash.acknowledged:
                    raise
                refused += 1
                if refused % 5:
                    continue
                case.run(path, overwrite=True).close()
        assert same(contents(path), undisturbed), f"{crash.how} before {crash.at}"
        assert [each.name for each in folder.iterdir()] == ["run.h5"]
    return resumed, refused


def ran(case, folder):
    """Run in a new folder; return its operations with the result that nothing disturbed."""
    folder.mkdir()
    with recorded(folder) as work:
        saves = Acknowledge(tell=work.acknowledge)
        case.run(folder / "run.h5", observers=[saves]).close()
    return work, contents(folder / "run.h5")


def test_a_run_goes_on_to_the_same_bits_from_a_crash_before_each_file_operation(
    tmp_path, monkeypatch
):
    # A checkpoint at every step, and those of saves.
    monkeypatch.setattr(tribo_run, "Recorder", partial(Recorder, checkpoint_every=0.0))
    case, folder = averaged(), tmp_path / "run"
    work, undisturbed = ran(case, folder)
    crashes = of_each_kind(work.crashes())
    resumed, refused = resumed_from_each(crashes, case, folder, undisturbed)
    # Before the first checkpoint there is nothing to go on from; the last one is done.
    assert len(crashes) == resumed + refused + 1
    assert resumed > 15 > refused


def test_what_goes_on_goes_on_again_from_a_crash_before_each_of_its_file_operations(tmp_path):
    case, folder = averaged(), tmp_path / "run"
    work, undisturbed = ran(case, folder)
    last = [crash for crash in work.crashes() if crash.acknowledged == 1][-1]
    last.lay(folder)
    with recorded(folder) as again:
        again.acknowledge()
        saves = Acknowledge(tell=again.acknowledge)
        case.resume(folder / "run.h5", observers=[saves]).close()
    crashes = of_each_kind(again.crashes()[1:])
    resumed, refused = resumed_from_each(crashes, case, folder, undisturbed)
    assert (resumed, refused) == (len(crashes) - 1, 0)


def test_steps_that_remember_go_on_to_the_same_bits_from_each_checkpoint(tmp_path):
    case, folder = resolved(), tmp_path / "run"
    work, undisturbed = ran(case, folder)
    files = "run.h5.run/checkpoint", "run.h5.run/checkpoint.previous"
    checkpoints = {
        crash.files[files[0]]: crash for crash in work.crashes() if {*files} <= crash.files.keys()
    }
    resumed, _ = resumed_from_each(checkpoints.values(), case, folder, undisturbed)
    assert resumed == 2


def compared(folder):
    done = tribo("compare", "run.toml", "--vary", "load=50 N,60 N", "--no-plots", cwd=folder)
    assert done.returncode == 0, done.stderr


def swept(folder):
    sweep(folder / "run.toml", {"load.normal": ["50 N"]}, executor=sweeps.Inline())


@pytest.mark.parametrize("runs", [compared, swept])
def test_runs_side_by_side_end_alike_from_a_crash_before_each_file_operation(tmp_path, runs):
    folder = tmp_path / "work"
    folder.mkdir()
    explicit = {"grid": WINDOW, "stepping": Explicit(time_step=0.5)}
    tables = case(kinematics=motion(duration=1), **explicit).model_dump(mode="json")
    (folder / "run.toml").write_text(to_toml(tables))
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
