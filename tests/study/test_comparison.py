"""Results side by side: what is the same differs by round-off, what is not by what was changed."""

import json
import shutil
import tomllib
import warnings
from pathlib import Path

import numpy as np
import pytest
from made_results import written
from pydantic import PrivateAttr

from tribo import (
    Interrupted,
    Observer,
    Registry,
    Result,
    TriboWarning,
    compare,
)
from tribo.config.load import validate_case
from tribo.contact.winkler import Winkler
from tribo.core.errors import CaseError, NumericalError
from tribo.simulation import run
from tribo.study.differences import differences
from tribo.study.runs import file_names
from tribo.study.variation import short_labels
from tribo.templates import template

K, MU = 3.11e-16, 0.1
SHORT = {
    "grid": {"size": "0.9 mm", "cells": 26},
    "output": {"save_times": [0, 100]},
}


def case(**changes):
    data = tomllib.loads(template("ball_on_disk")) | SHORT | changes
    data["kinematics"]["duration"] = 300
    return data


CONTACTS = {"contact.type": ("dcfft", "winkler")}


def both(law):
    return {f"bodies.{name}.wear": law for name in ("ball", "disk")}


@pytest.fixture(scope="module")
def foundations(tmp_path_factory):
    with compare(case(), CONTACTS, tmp_path_factory.mktemp("whole")) as comparison:
        yield comparison


@pytest.fixture
def done(foundations, tmp_path):
    """Return a folder with the same results."""
    kept = Path(foundations.results["dcfft"].name).parent
    return shutil.copytree(kept, tmp_path / "done")


def assert_same(one, other):
    for a, b in zip(one.results.values(), other.results.values(), strict=True):
        assert a.status == "done"
        assert np.array_equal(a.field("pressure", -1), b.field("pressure", -1))


@pytest.mark.slow
def test_energy_wear_with_alpha_k_over_mu_is_archards_to_round_off():
    data = case(friction={"coefficient": MU}, effects=["energy.friction_traction"])
    laws = [
        both({"type": "archard", "k": K}),
        both({"type": "energy.dissipation", "alpha": K / MU}),
    ]
    with compare(data, laws, labels=["archard", "energy"]) as comparison:
        archard, energy = comparison.results.values()
        assert energy.case["bodies"]["ball"]["wear"]["type"] == "energy.dissipation"
        assert comparison.times == [0, 100, 300]
        for time in comparison.times:
            for each in differences(energy, archard, time):
                # α μ is k to the last bit; a hundred steps amplify it.
                assert each.largest < 1e-12, each
        # The same number can differ: a tenth more of α shows.
        more = [laws[0], both({"type": "energy.dissipation", "alpha": 1.1 * K / MU})]
    with compare(data, more) as comparison:
        (worn,) = (
            d
            for d in differences(*reversed(comparison.results.values()), 300.0)
            if d.field == "bodies.ball.wear_depth"
        )
        assert worn.largest == pytest.approx(0.05, abs=0.02)


def test_the_first_contact_on_springs_has_four_thirds_of_the_peak(foundations):
    half_space, springs = foundations.results
    assert (half_space, springs) == ("dcfft", "winkler")
    assert foundations.settings[springs] == {"contact.type": "winkler"}
    peaks = [foundations.save(label, 0.0)["max_pressure_Pa"] for label in foundations.results]
    # 26 cells on the window are eight across the contact.
    assert peaks[1] / peaks[0] == pytest.approx(4 / 3, rel=0.03)


def test_norms_are_those_of_the_fields(foundations):
    half_space, springs = foundations.results.values()
    (pressure,) = differences(springs, half_space, 0.0)
    p, q = springs.field("pressure", 0), half_space.field("pressure", 0)
    assert pressure.field == "pressure"
    assert pressure.l2 == pytest.approx(np.linalg.norm(p - q) / np.linalg.norm(q))
    assert pressure.largest == pytest.approx(np.max(np.abs(p - q)) / np.max(q))
    # Once worn, depths are compared as well.
    fields = [each.field for each in differences(springs, half_space, 300.0)]
    assert fields == ["pressure", "bodies.ball.wear_depth", "bodies.disk.wear_depth"]


def test_json_has_every_common_save_and_is_json(foundations):
    data = json.loads(json.dumps(foundations.as_json(), allow_nan=False))
    assert data["reference"] == "dcfft"
    assert [each["label"] for each in data["results"]] == ["dcfft", "winkler"]
    assert data["results"][1]["settings"] == {"contact.type": "winkler"}
    assert data["results"][0]["totals"]["contact_solves"] > 10
    assert [save["time_s"] for save in data["saves"]] == [0, 100, 300]
    last = data["saves"][-1]
    assert last["results"]["winkler"]["max_pressure_Pa"] > 0
    assert last["differences"].keys() == {"winkler"}
    assert last["differences"]["winkler"]["pressure"].keys() == {"l2", "largest"}


def opened(folder, *times, **options):
    """Compare made results that were saved at these times."""
    return compare([written(folder / f"{i}.h5", times=t) for i, t in enumerate(times)], **options)


def test_only_common_saves_count(tmp_path):
    with opened(tmp_path, (0, 50, 100, 300), (0, 100, 150, 300)) as comparison:
        assert comparison.times == [0, 100, 300]
        assert comparison.chosen_times() == [0, 300]
        assert comparison.chosen_times([100]) == [100]
        with pytest.raises(CaseError, match="has no save at 50 s; its saves are at"):
            comparison.chosen_times([50])


def test_a_run_that_goes_on_alone_is_told(tmp_path):
    with opened(tmp_path, (0, 100, 300), (0, 100)) as comparison:
        assert comparison.notes == ["0 goes on to 300 s, beyond the last common save"]


def test_results_without_a_common_save_are_refused(tmp_path):
    with pytest.raises(CaseError, match="no time of a save in common: 0 <Result"):
        opened(tmp_path, (0, 100), (50, 150))


def test_what_is_done_is_not_done_again(done):
    before = {path.name: path.stat().st_mtime_ns for path in done.iterdir()}
    assert set(before) == {"contact.type=dcfft.h5", "contact.type=winkler.h5"}
    told = []
    compare(case(), CONTACTS, done, tell=told.append).close()
    assert all("done already" in line for line in told)
    assert {path.name: path.stat().st_mtime_ns for path in done.iterdir()} == before


def test_a_folder_with_another_case_is_left_alone(done):
    with pytest.raises(CaseError, match="is the result of another case; choose another folder"):
        compare(case(load={"normal": 120}), CONTACTS, done)
    with compare(case(load={"normal": 120}), CONTACTS, done, overwrite=True) as comparison:
        assert all(r.case["load"]["normal"] == 120 for r in comparison.results.values())


@pytest.mark.slow
def test_a_run_that_was_interrupted_goes_on(foundations, tmp_path):
    class StopAt(Observer):
        def on_step(self, snapshot):
            if snapshot.state.steps == 20:
                raise KeyboardInterrupt

    with pytest.raises(Interrupted, match=r"^contact\.type=dcfft: stopped at"):
        compare(case(), CONTACTS, tmp_path, observers=lambda: [StopAt()])
    with compare(case(), CONTACTS, tmp_path) as resumed:
        assert_same(resumed, foundations)


@pytest.mark.slow
def test_a_run_that_was_killed_goes_on(tmp_path):
    class Watch(Observer):
        """Copies what a kill would leave after 150 s, and notes the times of all steps."""

        kept: Path | None = None
        _times: list[float] = PrivateAttr(default_factory=list)

        def on_step(self, snapshot):
            self._times.append(snapshot.state.time)
            if self.kept and self._times[-1] > 150 and not self.kept.exists():
                shutil.copytree(tmp_path / "whole", self.kept)

    first, second = Watch(kept=tmp_path / "killed"), Watch()
    with (
        compare(case(), CONTACTS, tmp_path / "whole", observers=lambda: [first]) as whole,
        compare(case(), CONTACTS, tmp_path / "killed", observers=lambda: [second]) as resumed,
    ):
        # The second variant begins anew.
        assert second._times[0] >= 100
        assert min(second._times) == 0
        assert_same(resumed, whole)


def test_a_run_that_fails_as_it_goes_on_keeps_what_was_saved(tmp_path, monkeypatch):
    def march(model, state, error):
        raise error
        yield

    path = tmp_path / "contact.type=dcfft.h5"
    monkeypatch.setattr(run, "march", lambda *given: march(*given, KeyboardInterrupt()))
    with pytest.raises(Interrupted):
        compare(case(), CONTACTS, tmp_path)
    monkeypatch.setattr(run, "march", lambda *given: march(*given, CaseError("too long a step")))
    monkeypatch.setattr(run, "begin", None)
    with pytest.raises(CaseError, match="too long a step"):
        compare(case(), CONTACTS, tmp_path)
    with Result.open(path) as result:
        assert result.notices == ("failed: too long a step",)
        assert list(result.times) == [0]


@pytest.mark.parametrize("damaged", [False, True])
def test_a_file_that_is_not_a_sound_result_is_kept(done, damaged):
    path = done / "contact.type=dcfft.h5"
    content = bytearray(path.read_bytes() if damaged else b"my notes")
    content[len(content) // 2] ^= 1
    path.write_bytes(content)
    with pytest.raises(CaseError, match=r"dcfft\.h5 is .* or run all anew with --force"):
        compare(case(), CONTACTS, done)
    assert path.read_bytes() == content


def test_an_empty_result_is_made_anew(done):
    path = done / "contact.type=dcfft.h5"
    path.write_bytes(b"")
    told = []
    with pytest.warns(TriboWarning, match=r"dcfft\.h5 is begun anew: .* cut short"):
        compare(case(), CONTACTS, done, tell=told.append).close()
    assert ["done already" in line for line in told] == [False, True]
    with Result.open(path) as result:
        result.check()


@pytest.mark.slow
def test_a_run_that_fails_is_named():
    data = case(stepping={"type": "explicit", "time_step": 0.25})
    settings = {"stepping.time_step": (0.25, 1e4)}
    with pytest.raises((CaseError, NumericalError), match=r"^stepping\.time_step=10000\.0: "):
        compare(data, settings)


def test_variants_are_validated_before_any_runs(tmp_path):
    with pytest.raises(CaseError, match="did you mean 'winkler'"):
        compare(case(), {"contact.type": ("dcfft", "winklr")}, tmp_path / "new")
    assert not (tmp_path / "new").exists()


@pytest.mark.parametrize("count", [0, 1, 13])
def test_there_must_be_something_to_compare_and_not_too_much(count):
    settings = [{"load.normal": 10.0 + i} for i in range(count)]
    with pytest.raises(CaseError, match=f"^{count} variants?; give 2 to 12"):
        compare(case(), settings)


def test_labels_must_be_different():
    with pytest.raises(CaseError, match="2 variants need as many different labels"):
        compare(case(), {"load.normal": (50, 100)}, labels=["a", "a"])


def test_values_alone_are_the_labels_where_the_paths_are_the_same():
    both_vary = [
        {"load.normal": "120 N", "contact": "winkler"},
        {"load.normal": 100, "contact": "winkler"},
    ]
    assert short_labels(both_vary) == ["120 N, winkler", "100, winkler"]
    apart = [{"load.normal": 120}, {"contact.type": "winkler"}]
    assert short_labels(apart) == ["load.normal=120", "contact.type=winkler"]


def test_files_are_compared_under_their_names(tmp_path):
    (tmp_path / "other").mkdir()
    a, b, c = (written(tmp_path / name) for name in ("a.h5", "b.h5", "other/a.h5"))
    with compare([a, b]) as comparison:
        assert list(comparison.results) == ["a", "b"]
        assert comparison.settings == {}
    with compare([a, b, c]) as comparison:
        assert list(comparison.results) == [str(path) for path in (a, b, c)]


@pytest.mark.parametrize(
    ("names", "message"),
    [
        ((), "nothing to be compared with"),
        (("a.h5",), "nothing to be compared with"),
        (("a.h5", "a.h5"), r"a\.h5 is given twice"),
        (("a.h5", "none.h5"), "is not a file"),
    ],
)
def test_files_that_cannot_be_compared_are_refused(tmp_path, names, message):
    written(tmp_path / "a.h5")
    with pytest.raises(CaseError, match=message):
        compare([tmp_path / name for name in names])


def test_a_notice_of_several_runs_is_told_once():
    coarse = case(grid={"size": "0.9 mm", "cells": 12})
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", TriboWarning)
        with compare(coarse, CONTACTS) as comparison:
            (note,) = comparison.notes
    assert note.startswith("dcfft; winkler: resolution: ")


def test_file_names_are_safe_and_different():
    names = file_names(["load.normal=50 N", "load.normal=50/N", "a" * 200, "a" * 201])
    assert names[:2] == ["load.normal=50_N.h5", "load.normal=50_N~1.h5"]
    assert len(set(names)) == 4
    assert max(map(len, names)) < 120


def test_a_case_object_is_compared_with_a_registry_of_ones_own():
    registry = Registry.with_plugins()
    with compare(validate_case(case()), CONTACTS, registry=registry) as comparison:
        assert registry.lookup("contact_solver", "winkler") is Winkler
        assert list(comparison.results) == ["dcfft", "winkler"]
