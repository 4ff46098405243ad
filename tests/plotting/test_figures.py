"""Pictures on disk: which, for whatever kind of result."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from made_results import TIMES, made
from matplotlib.image import imread

from tribo.core.errors import CaseError, OutputError
from tribo.plotting import pressure_sections, save_figures

CONTACT = ["pressure_map", "pressure_map_early", "pressure_sections"]
OVER_TIME = ["wear_history", "contact_history"]
BALL = ["ball_along", "ball_across"]


def written(result, folder, suffix="svg"):
    paths = save_figures(result, folder, suffix)
    assert all(path.stat().st_size > 2000 for path in paths)
    assert len(set(paths)) == len(paths)
    return [path.stem for path in paths]


def test_the_pictures_are_images_of_the_width_of_a_column(tmp_path):
    for path in save_figures(made(), tmp_path):
        image = imread(path)
        wide = path.stem in ("pressure_sections", "worn_section")
        assert image.shape[1] == pytest.approx((130 if wide else 85) / 25.4 * 200, abs=1)
        grey = image[..., :3].mean(axis=2)
        # Paper, ink, and neither everywhere.
        assert grey.min() < 0.2
        assert grey.max() == 1.0
        assert 0.02 < np.mean(grey < 0.95) < 0.9


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({}, [*CONTACT, *BALL, "disk_groove", "worn_section", *OVER_TIME]),
        ({"times": (0.0,)}, ["pressure_map", "pressure_sections"]),
        (
            {"times": (0.0, 123.4567), "status": "interrupted"},
            [
                "pressure_map",
                "pressure_sections",
                *BALL,
                "disk_groove",
                "worn_section",
                *OVER_TIME,
            ],
        ),
        ({"worn": (True, False)}, [*CONTACT, *BALL, "worn_section", *OVER_TIME]),
        ({"worn": (False, True)}, [*CONTACT, "disk_groove", "worn_section", *OVER_TIME]),
        ({"worn": (False, False)}, [*CONTACT, "contact_history"]),
        (
            {"swept": (True, True), "names": ("wheel-1", "Wheel_β")},
            [*CONTACT, "wheel-1_groove", "Wheel_β_groove", "worn_section", *OVER_TIME],
        ),
        (
            {"swept": (False, False)},
            [*CONTACT, *BALL, "disk_along", "disk_across", "worn_section", *OVER_TIME],
        ),
        (
            {"worn": (False, False), "plastic": 2e-7, "cap": 2e9, "times": (0.0,)},
            ["pressure_map", "pressure_sections", *BALL, "disk_groove", "worn_section"],
        ),
        ({"curvature": None}, [*CONTACT, *BALL, "disk_groove", "worn_section", *OVER_TIME]),
        (
            {"curvature": (0.0, 200.0)},
            [*CONTACT, *BALL, "disk_groove", "worn_section", *OVER_TIME],
        ),
        (
            {"densities": (None, 3200.0), "names": ("_pin", "_disk")},
            [*CONTACT, "_pin_along", "_pin_across", "_disk_groove", "worn_section", *OVER_TIME],
        ),
        (
            {"times": tuple(np.arange(40.0))},
            [*CONTACT, *BALL, "disk_groove", "worn_section", *OVER_TIME],
        ),
    ],
    ids=[
        "both wear",
        "first contact only",
        "interrupted",
        "one wears",
        "the other wears",
        "none wears",
        "twin disks",
        "neither swept",
        "indentation",
        "no curvature",
        "line contact",
        "one density",
        "many saves",
    ],
)
def test_each_result_gets_the_pictures_that_make_sense(changes, expected, tmp_path):
    assert written(made(**changes), tmp_path / "new" / "folder") == expected


def test_a_result_without_saves_is_said_to_hold_none(tmp_path):
    with pytest.raises(CaseError, match="no save yet"):
        save_figures(made(()), tmp_path)


def test_an_unknown_format_is_named_with_those_known(tmp_path):
    with pytest.raises(CaseError, match=r"'bmp7'; use one of .*png"):
        save_figures(made(), tmp_path, "bmp7")


def test_a_place_that_cannot_be_written_is_an_output_error(tmp_path):
    (tmp_path / "taken").write_text("")
    with pytest.raises(OutputError, match="cannot write to"):
        save_figures(made((0.0,)), tmp_path / "taken")


@pytest.mark.parametrize("suffix", ["pdf", ".svg"])
def test_the_same_result_gives_the_same_file(suffix, tmp_path):
    result = made((0.0,))
    one, other = (save_figures(result, tmp_path / str(i), suffix)[1] for i in range(2))
    assert one.read_bytes() == other.read_bytes()


def test_threads_can_draw_at_the_same_time():
    result = made()
    with ThreadPoolExecutor(4) as pool:
        figures = list(pool.map(lambda _: pressure_sections(result), range(8)))
    assert {figure.axes[0].xaxis.label.get_fontsize() for figure in figures} == {8.0}
    assert {len(figure.axes[0].lines) for figure in figures} == {len(TIMES) + 1}
