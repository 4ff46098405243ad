"""`tribo scar` as a user meets it, its pictures and its files."""

import json

import numpy as np
import pytest
from click.testing import CliRunner
from scar_maps import PITCH, RADIUS, cap, of_flat, pair, places, seen, volume
from tribo import CaseError, Heights, Registry, TriboWarning, read_heights
from tribo.registry import all_plugins
from tribo.registry.plugins import builtin

from tribo_scar import measured_scar, measured_scar_map
from tribo_scar.command import scar as command


@pytest.mark.slow
def test_the_command_measures_and_draws(tmp_path):
    before, after, lost = pair(on=RADIUS)
    np.save(tmp_path / "before.npy", before.heights)
    np.savetxt(tmp_path / "after.csv", after.heights, delimiter=",")
    files = [str(tmp_path / name) for name in ("before.npy", "after.csv")]
    picture = tmp_path / "scar.png"
    given = [*files, "--pitch", "1 um", "--radius", "5 mm", "-o", str(picture)]
    given += ["-o", str(tmp_path / "depth.NPY")]
    done = CliRunner().invoke(command, given, catch_exceptions=False)
    assert float(done.output.split("volume in the map, mm³")[1].split()[0]) == pytest.approx(
        1e9 * volume(lost), rel=0.01, abs=0
    )
    assert "flat scar (ASTM G99)" in done.output
    shift = float(done.output.split("of the map after along x, µm")[1].split()[0])
    assert shift == pytest.approx(seen()[0], abs=0.1)
    assert picture.stat().st_size > 10_000
    assert done.output.count("Wrote ") == 2
    depth = np.load(tmp_path / "depth.NPY")
    # Whole, so that its middle is that of the map after.
    assert depth.shape == after.heights.shape
    assert np.nansum(depth) == pytest.approx(np.sum(lost), rel=0.1)
    assert np.nanstd(depth - lost) < 0.1 * np.max(lost)
    ideal = [files[1], *given[2:4], "--ideal", '{ type = "sphere", radius = "5 mm" }', "--json"]
    told = CliRunner().invoke(command, ideal, catch_exceptions=False)
    assert '"volume_uncertainty_m3"' in told.output
    assert json.loads(told.output)["cut_off"] is False
    with pytest.raises(CaseError, match=r"has heights and no scale; .*--pitch"):
        CliRunner().invoke(command, files, catch_exceptions=False)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ([], "1 file is given; give the maps before and after"),
        (["a.npy", "a.npy"], "3 files are given"),
        (["--ideal", "flat", "--pitch", "5"], r"--pitch: .*no unit"),
        (["--ideal", "flat", "--pitch", "5 mm"], r"--pitch: 5 mm: must be .*at most 1 mm"),
        (["--ideal", "sphere"], "--ideal radius: missing"),
        (["-o", "none/scar.png"], "there is no folder none; make it with: mkdir none"),
        (["--ideal", "flat", "-o", "./a.npy"], r"--output: a\.npy is a measured map; give another"),
        (["--ideal", '{ type = "sphere" r'], r"--ideal: '{ type = \"sphere\" r'"),
    ],
)
def test_wrong_words_of_the_command_are_told(given, words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    np.save("a.npy", np.zeros((32, 32)))
    with pytest.raises(CaseError, match=words):
        CliRunner().invoke(command, ["a.npy", "--pitch", "1 um", *given], catch_exceptions=False)


def test_the_command_says_what_the_maps_do_not_tell_and_what_is_cut_off(tmp_path):
    x, y = places()
    np.save(tmp_path / "after.npy", of_flat(cap(x - 35e-6, y), 1e-9).heights)
    given = [str(tmp_path / "after.npy"), "--pitch", "1 um", "--ideal", "flat"]
    with pytest.warns(TriboWarning, match="cuts the scar off"):
        done = CliRunner().invoke(command, given, catch_exceptions=False)
    # Both shifts, the rotation, and both widths.
    assert done.output.count("undetermined") == 5
    assert "inf" not in done.output


def test_a_unit_of_heights_is_given_where_a_file_states_none(standard, tmp_path):
    heights = standard[1].heights
    np.save(tmp_path / "micro.npy", 1e6 * heights)
    read = read_heights(tmp_path / "micro.npy", (PITCH, PITCH), "µm")
    assert read.heights == pytest.approx(heights, rel=1e-12, abs=0, nan_ok=True)
    with pytest.raises(CaseError, match=r"^unit: .*'1 kg'"):
        read_heights(tmp_path / "micro.npy", (PITCH, PITCH), "kg")
    with pytest.raises(CaseError, match="states its own unit"):
        read_heights(tmp_path / "map.x3p", unit="nm")


def test_heights_in_micrometres_and_fill_values_are_told_by_their_file(standard, tmp_path):
    heights = standard[1].heights
    filled = np.where(np.isnan(heights), -9999, heights)
    for name, wrong in {"micro": 1e6 * heights, "filled": filled}.items():
        np.save(tmp_path / f"{name}.npy", wrong)
        words = rf"{name}\.npy: .* lie further .* wide, 0\.096 mm; .*Put NaN for fill .*--unit µm"
        with pytest.raises(CaseError, match=words):
            read_heights(tmp_path / f"{name}.npy", (PITCH, PITCH))
    # An instrument may count heights from its own stage.
    assert Heights(heights + 1.0, (PITCH, PITCH)).heights.shape == heights.shape


def test_the_picture_outlines_what_is_piled_up():
    before, after, *_ = pair(missing=0.0)
    ridge = 3e-7 * np.exp(-((np.hypot(*places()) / PITCH - 26) ** 2) / 8)
    found = measured_scar(before, Heights(after.heights + ridge, after.pitch))
    figure = measured_scar_map(found)
    (legend,) = figure.legends
    words = {text.get_text() for text in legend.get_texts()} - {"taken for the volume", "piled up"}
    (widths,) = words
    # The ring is as wide as the widths that are printed.
    (ring,) = figure.axes[0].patches
    size = {"mm": 1e-3, "µm": 1e-6}[widths[-2:]]
    sizes = size * ring.width, size * ring.height
    assert sizes == pytest.approx((found.along, found.across))


def test_a_file_of_a_format_that_nothing_reads_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(all_plugins, "default_registry", lambda: Registry([builtin()]))
    with pytest.raises(CaseError, match=r"map\.x3p is no NumPy or CSV file .* install tribo-t"):
        read_heights(tmp_path / "map.x3p")
    (tmp_path / "list.csv").write_text("1,2,3\n4,5,6\n")
    with pytest.raises(CaseError, match=r"list\.csv: .* a list of x, y, z is no map"):
        read_heights(tmp_path / "list.csv", (PITCH, PITCH))
    with pytest.raises(CaseError, match=r"there is no file .*map\.npy"):
        read_heights(tmp_path / "map.npy")
