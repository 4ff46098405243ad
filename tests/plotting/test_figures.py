"""Pictures on disk: which, for whatever kind of result."""

from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise

import numpy as np
import pytest
from made_results import SHAPES, TIMES, made
from matplotlib.figure import Figure
from matplotlib.image import imread

from tribo.core.errors import CaseError, OutputError
from tribo.plotting import pressure_sections, save_figures

CONTACT = ["pressure_map", "pressure_map_early", "pressure_sections"]
OVER_TIME = ["wear_history", "contact_history"]
WORN = ["disk_groove", "worn_section"]
BALL = ["ball_along", "ball_across"]


@pytest.mark.slow
def test_the_pictures_are_images_of_the_width_of_a_column(tmp_path):
    paths = save_figures(made(), tmp_path / "new" / "folder")
    assert [path.stem for path in paths] == [*CONTACT, *BALL, *WORN, *OVER_TIME]
    for path in paths:
        image = imread(path)
        wide = path.stem in ("pressure_sections", "worn_section")
        assert image.shape[1] == pytest.approx((130 if wide else 85) / 25.4 * 200, abs=1)
        grey = image[..., :3].mean(axis=2)
        # Paper, ink, and neither everywhere.
        assert grey.min() < 0.2
        assert grey.max() == 1.0
        assert 0.02 < np.mean(grey < 0.95) < 0.9


CASES = {
    "first contact only": ({"times": (0.0,)}, ["pressure_map", "pressure_sections"]),
    "interrupted": (
        {"times": (0.0, 123.4567), "status": "interrupted"},
        ["pressure_map", "pressure_sections", *BALL, *WORN, *OVER_TIME],
    ),
    "one wears": ({"worn": (True, False)}, [*CONTACT, *BALL, "worn_section", *OVER_TIME]),
    "none wears": ({"worn": (False, False)}, [*CONTACT, "contact_history"]),
    "twin disks, one heavier": (
        {"swept": (True, True), "names": ("wheel-1", "Wheel_β"), "densities": (7850.0, 3200.0)},
        [*CONTACT, "wheel-1_groove", "Wheel_β_groove", "worn_section", *OVER_TIME],
    ),
    "neither swept, no curvature": (
        {"swept": (False, False), "curvature": None},
        [*CONTACT, *BALL, "disk_along", "disk_across", "worn_section", *OVER_TIME],
    ),
    "indentation": (
        {"worn": (False, False), "plastic": 2e-7, "cap": 2e9, "times": (0.0,)},
        ["pressure_map", "pressure_sections", *BALL, *WORN],
    ),
    "many saves, a line contact, one density": (
        {
            "times": tuple(np.arange(40.0)),
            "curvature": (0.0, 200.0),
            "densities": (None, 3200.0),
            "names": ("_ball", "disk"),
        },
        [*CONTACT, "_ball_along", "_ball_across", *WORN, *OVER_TIME],
    ),
}


CASES |= {name: (shape, [*CONTACT, *BALL, *WORN, *OVER_TIME]) for name, shape in SHAPES.items()}
UNITS = tuple(f"({unit})" for unit in ("mm", "µm", "nm", "pm", "MPa", "s", "mm³", "mg"))


def check_layout(figure):
    """Nothing is cut off, no labels of ticks overlap, and axes with numbers name a unit."""
    figure.draw_without_rendering()
    text, paper = figure.get_tightbbox(), figure.bbox_inches
    assert min(text.x0, text.y0, paper.x1 - text.x1, paper.y1 - text.y1) > -0.01
    for axes in [each for parent in figure.axes for each in (parent, *parent.child_axes)]:
        for axis in (axes.xaxis, axes.yaxis):
            low, high = sorted(axis.get_view_interval())
            labels = zip(axis.get_majorticklocs(), axis.get_majorticklabels(), strict=False)
            boxes = [
                label.get_window_extent()
                for place, label in labels
                if low <= place <= high and label.get_visible() and label.get_text()
            ]
            assert not any(one.overlaps(other) for one, other in pairwise(boxes))
            assert not boxes or axis.get_label_text().split("\n")[0].endswith(UNITS)


@pytest.mark.slow
@pytest.mark.parametrize(("changes", "expected"), CASES.values(), ids=CASES)
def test_each_result_gets_the_pictures_that_make_sense(changes, expected, tmp_path, monkeypatch):
    drawn = []

    def lay_out(figure, path, **_):
        # All of the work but the pixels, which take long.
        check_layout(figure)
        drawn.append(path)

    monkeypatch.setattr(Figure, "savefig", lay_out)
    paths = save_figures(made(**changes), tmp_path)
    assert paths == drawn == [tmp_path / f"{name}.png" for name in expected]


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


@pytest.mark.slow
@pytest.mark.parametrize("suffix", ["pdf", ".svg"])
def test_the_same_result_gives_the_same_file(suffix, tmp_path):
    result = made((0.0,))
    one, other = (save_figures(result, tmp_path / str(i), suffix)[1] for i in range(2))
    assert one.read_bytes() == other.read_bytes()


@pytest.mark.slow
def test_threads_can_draw_at_the_same_time():
    result = made()
    with ThreadPoolExecutor(4) as pool:
        figures = list(pool.map(lambda _: pressure_sections(result), range(8)))
    assert {figure.axes[0].xaxis.label.get_fontsize() for figure in figures} == {8.0}
    assert {len(figure.axes[1].lines) for figure in figures} == {len(TIMES) + 1}
