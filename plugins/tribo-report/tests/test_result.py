"""The report of a result: one small page, with the numbers of the lab."""

import base64
import gzip
import json
import re
import tomllib
from itertools import pairwise
from typing import Annotated

import numpy as np
import pytest
import tribo
from command_line import tribo as command
from made_results import GRID, SHAPES, made, written
from pages import Checked
from tribo import Effect, Quantity
from tribo.config.load import case_tables
from tribo.templates import template

from tribo_report.amounts import component_words, value_words
from tribo_report.fields import charts
from tribo_report.reduced import Blocks, block_means, each_plain
from tribo_report.result import result_page
from tribo_report.sentence import read_verified, sentence


def unpacked(page):
    (text,) = re.findall(r'<script id="data" type="text/plain">(.*?)</script>', page, re.S)
    return json.loads(gzip.decompress(base64.b64decode(text)))


@pytest.fixture(scope="module")
def ran(tmp_path_factory):
    folder = tmp_path_factory.mktemp("report")
    written(folder / "my.h5", times=(0.0, 200.0))
    return folder, command("report", "my.h5", cwd=folder)


@pytest.fixture(scope="module")
def page(ran):
    folder, done = ran
    assert done.returncode == 0, done.stderr
    assert "Wrote my-report.html" in done.stdout
    return (folder / "my-report.html").read_text(encoding="utf-8")


@pytest.fixture
def unprinted(monkeypatch):
    """Leaves out the pictures for paper, which take the most time."""
    monkeypatch.setattr("tribo_report.result.stills", lambda pictures: [])


def test_it_is_one_small_file_that_loads_nothing(page):
    assert len(page.encode()) < 4_000_000
    checked = Checked(page)
    assert all(link.startswith("data:") for link in checked.links)
    assert "default-src 'none'" in page
    assert len(set(checked.ids)) == len(checked.ids)
    assert checked.headings[0] == 1
    assert all(below - above <= 1 for above, below in pairwise(checked.headings))


def test_its_sentence_has_the_numbers_of_the_lab(ran, page):
    with tribo.open(ran[0] / "my.h5") as result:
        ball = result.saves()[-1]["bodies"]["ball"]
        volume, depth = ball["wear_volume_m3"], ball["max_wear_depth_m"]
        mass = result.report().bodies["ball"].mass_kg
    (answer,) = re.findall('<p class="answer">(.*?)</p>', page, re.S)
    assert f"the ball lost {1e9 * volume:.3g} mm³ ({1e6 * mass:.3g} mg)" in answer
    assert f"worn {1e6 * depth:.3g} µm deep" in answer
    assert "Over 20 m of sliding under 100 N the ball" in answer


def test_it_quotes_the_uncertainty_that_a_study_found(tmp_path):
    """Which has nothing to say of a body without wear."""
    study = tmp_path / "study.json"
    with made(times=(0.0, 3600.0), worn=(True, False)) as result:
        ball = result.saves()[-1]["bodies"]["ball"]
        keys = {"volume": ("m^3", "wear_volume_m3"), "largest depth": ("m", "max_wear_depth_m")}
        rows = [
            {"name": f"ball: {what}", "unit": unit, "value": ball[key]}
            | {"uncertainty": 0.02 * ball[key]}
            for what, (unit, key) in keys.items()
        ]
        study.write_text(json.dumps({"estimates": rows}))
        found = sentence(result, result.report(), read_verified(study, result))
        assert "the ball lost 0.01120 ± 0.00022 mm³ (0.0879 mg) and is worn" in found
        assert re.search(r"worn \d+\.\d\d ± 0\.\d\d µm deep", found)
        rows[0]["value"] *= 1.1
        wrong = {
            json.dumps({"estimates": rows}): "another case: ball of",
            "[]": "--verified: .* is not what 'tribo verify CASE",
        }
        for text, words in wrong.items():
            study.write_text(text)
            with pytest.raises(tribo.CaseError, match=words):
                read_verified(study, result)
        with pytest.raises(tribo.CaseError, match=r"^--verified: .*: there is no such file$"):
            read_verified(tmp_path / "none.json", result)


@pytest.mark.parametrize("shape", SHAPES)
def test_every_shape_of_contact_has_its_charts(shape):
    with made(times=(0.0, 200.0), **SHAPES[shape]) as result:
        data = charts(result)
        largest = result.saves()[-1]["max_pressure_Pa"]
    first = data["maps"][0]
    assert len(data["saves"]) == len(first["values"]) == 2
    assert len(first["values"][0]) == len(first["x"]) * len(first["y"])
    assert first["largest"][-1] == pytest.approx(largest / tribo.MPa, rel=1e-3)


def test_a_pressure_that_has_fallen_far_keeps_its_digits():
    """A logarithmic axis and the words above a map show them."""
    with made(times=(0.0, 3600.0)) as result:
        data = charts(result)
        column = 1e-6 * result.table("history")["max_pressure_Pa"]
    panels = {panel["name"]: panel for panel in data["history"]["axes"][0]["panels"]}
    drawn = panels["Contact pressure"]["curves"][0]["y"]
    np.testing.assert_allclose(drawn, column, rtol=5e-4)
    assert each_plain(np.array([1260.0, 14.3217, np.nan])) == [1260.0, 14.32, None]


def test_a_body_that_does_not_wear_has_no_map():
    with made(worn=(True, False)) as result:
        assert [each["body"] for each in charts(result)["maps"]] == ["", "ball"]
        assert [each["name"] for each in charts(result)["surfaces"]] == ["ball"]


@pytest.mark.slow
@pytest.mark.usefixtures("unprinted")
def test_what_effects_provide_and_models_keep_has_maps_and_curves():
    with made(times=(0.0, 3600.0), film=1e-11) as result:
        data, page = charts(result), result_page(result)
    assert "film, nm" in page
    assert [each["name"] for each in data["maps"][-2:]] == ["Film", "Load share"]
    panel = data["history"]["axes"][0]["panels"][-2]
    assert (panel["name"], panel["unit"], panel["dotted"]) == ("Film", "nm", True)
    assert panel["note"] == "A mark for each save; not known between."
    assert not data["history"]["axes"][0]["panels"][0]["dotted"]


def test_a_coating_is_told():
    layers = [{"thickness": 1e-5}, {"thickness": 1e-3}]
    with made(layers=layers) as result:
        told = "The coating (2 layers) of the ball is nowhere worn through."
        assert told in sentence(result, result.report(), [])


class Bathed(Effect):
    type = "test.bathed"
    softness: Annotated[float, Quantity("1/Pa")]
    shares: dict[str, Annotated[float, Quantity("N")]]


def test_every_number_of_the_case_has_its_unit_and_only_wear_coefficients_two():
    config = {"softness": 2e-8, "shares": {"pin": 2.0}}
    assert value_words(config, Bathed) == "softness 2e-08 1/Pa, shares pin 2 N"
    assert component_words({"type": "archard", "k": 1e-15}) == (
        "archard, k 1e-15 1/Pa = 1e-06 mm³/(N·m)"
    )


@pytest.mark.slow
@pytest.mark.usefixtures("unprinted")
def test_a_duty_cycle_is_told_and_drawn_with_its_pause_and_its_friction(tmp_path):
    settings = ["grid.cells=32", "grid.size='0.7 mm'", "output.save_times=[]"]
    settings += ["kinematics.duration=1800", "kinematics.positions='average'"]
    (tmp_path / "case.toml").write_text(template("ball_on_disk"), encoding="utf-8")
    case = case_tables(tribo.load_case(tmp_path / "case.toml", overrides=settings))
    case["kinematics"]["frequency"] = [
        {"until": 600.0, "frequency": 0.01},
        {"until": 1200.0, "frequency": 0.0},
        {"until": 1800.0, "frequency": 0.01},
    ]
    case["load"] = {"normal": [{"until": t, "normal": n} for t, n in ((900, 50), (1800, 100))]}
    with tribo.Simulation(case | {"friction": {"coefficient": 0.5}}).run() as result:
        page, work = result_page(result), result.saves()[-1]["friction_energy_J"]
        history = charts(result)["history"]["axes"][1]
        panels = {panel["name"]: panel["curves"][0] for panel in history["panels"]}
    assert "frequency 0.01 Hz to 10 min, pause to 20 min, 0.01 Hz to 30 min" in page
    assert "normal 50 N to 15 min, 100 N to 30 min" in page
    assert f"Friction: 50 N at the end, {work:.4g} J dissipated." in page
    assert panels["Work of friction"]["y"][-1] == pytest.approx(work, rel=1e-3)
    assert panels["Friction force"]["y"][-1] == pytest.approx(50, rel=1e-3)


def test_block_means_keep_the_load():
    blocks = [Blocks.of(x, 12) for x in (GRID.x, GRID.y)]
    x, y = GRID.mesh
    field = 1 + (x / GRID.size[0]) ** 2 + y / GRID.size[1]
    means = block_means(field, blocks)
    cells = np.outer(
        *(np.diff([*range(0, n, b.size), n]) for n, b in zip(GRID.cells, blocks, strict=True))
    )
    assert means.shape == cells.shape == (10, 10)
    assert np.sum(means * cells) == pytest.approx(np.sum(field), rel=1e-13)


def test_what_is_made_smaller_says_so():
    with made(times=tuple(np.linspace(0, 3600, 45)), shape=(4.0, 4.0)) as result:
        data = charts(result)
    assert len(data["saves"]) == 40
    assert data["left_out"] == 5
    assert "mean of 2 × 1 cells" in data["maps"][0]["note"]
    assert len(data["maps"][0]["x"]) == 25


def test_its_data_are_those_of_the_result_and_its_case_can_be_copied(page):
    assert unpacked(page)["saves"][-1] == {"time": "200 s", "distance": "20 m"}
    (case,) = re.findall(r'<pre id="case".*?>(.*?)</pre>', page, re.S)
    assert tomllib.loads(case)["grid"]["cells"] == [50, 40]
