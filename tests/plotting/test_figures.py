"""Pictures on disk: which, for whatever kind of result."""

import re
from itertools import pairwise

import numpy as np
import pytest
from made_results import SHAPES, made

from tribo.core.errors import CaseError
from tribo.core.grid import Grid
from tribo.plotting import figures, save_figures
from tribo.plotting.pressure import pressure_map

CONTACT = ["pressure_map", "pressure_sections"]
OVER_TIME = ["wear_history", "contact_history"]
SCARS = ["ball_scar", "disk_scar"]
PROFILES = ["ball_profiles", "disk_profiles"]
WORN = [*SCARS, *PROFILES, "worn_section"]
BALL = ["ball_scar", "ball_profiles", "worn_section"]
KEPT = ["film_map", "load_share_map"]
ROUGH = {"relief": 2e-7, "cap": 4e8}
COARSE = {**ROUGH, "grid": Grid((2e-3, 1.6e-3), (10, 8)), "times": (0.0, 200.0)}
INTERRUPTED = {"times": (0.0, 123.4567), "status": "interrupted"}
TWIN_WORN = ["wheel-1_scar", "Wheel_β_scar", "wheel-1_profiles", "Wheel_β_profiles"]
TWIN = {"swept": (True, True), "names": ("wheel-1", "Wheel_β"), "densities": (7850.0, 3200.0)}
MANY = {
    "times": tuple(np.arange(40.0)),
    "curvature": (0.0, 200.0),
    "densities": (None, 3200.0),
    "names": ("_ball", "disk"),
}
EVEN = {**SHAPES["flat pin"], "worn": (False, False)}
INDENTED = {"worn": (False, False), "plastic": 2e-7, "cap": 2e9, "times": (0.0,)}


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({"times": (0.0,)}, CONTACT),
        (INTERRUPTED, [*CONTACT, *WORN, *OVER_TIME]),
        ({"worn": (True, False)}, [*CONTACT, *BALL, *OVER_TIME]),
        ({"worn": (False, False)}, [*CONTACT, "contact_history"]),
        (TWIN, [*CONTACT, *TWIN_WORN, "worn_section", *OVER_TIME]),
        ({"swept": (False, False)}, [*CONTACT, *WORN, *OVER_TIME]),
        (INDENTED, [*CONTACT, *WORN]),
        (EVEN, ["contact_history"]),
        ({"film": 1e-11, "worn": (False, False)}, [*CONTACT, "contact_history", *KEPT]),
        (COARSE, [*CONTACT, *WORN, *OVER_TIME]),
        (ROUGH, [*CONTACT, *WORN, *OVER_TIME]),
    ],
)
def test_each_result_gets_the_pictures_that_make_sense(changes, expected, monkeypatch, tmp_path):
    monkeypatch.setattr(figures, "write_figures", lambda pictures, *_: list(pictures))
    assert save_figures(made(**changes), tmp_path) == expected


UNIT = re.compile(r"\((10\S+ )?(mm|µm|nm|pm|MPa|s|m|mm³|mm²)\)")
# Of each, the ends of the names of the pictures that it lays out otherwise than others do.
MAPS, SCARS = ("_map", "_sections"), ("_scar", "_profiles", "worn_section")
LAID_OUT = {
    "interrupted": (INTERRUPTED, ("_sections", "_history")),
    "indented": (INDENTED, SCARS),
    "twin disks": (TWIN, SCARS),
    "many saves": (MANY, ("_sections", "_profiles", "_history")),
    "rough": (ROUGH, ("",)),
    "flat pin": (SHAPES["flat pin"], (*MAPS, "_scar")),
    "long window": (SHAPES["long window"], (*MAPS, "_scar", "worn_section")),
    "1:1000": (SHAPES["1:1000"], (*MAPS, "_scar", "worn_section")),
    "hard": (SHAPES["hard"], MAPS),
}


@pytest.mark.slow
@pytest.mark.parametrize(("changes", "ends"), LAID_OUT.values(), ids=LAID_OUT)
def test_nothing_is_cut_off_no_labels_overlap_and_axes_name_a_unit(
    changes, ends, monkeypatch, tmp_path
):
    monkeypatch.setattr(figures, "write_figures", lambda pictures, *_: pictures)
    pictures = save_figures(made(**changes), tmp_path)
    for draw in [draw for name, draw in pictures.items() if name.endswith(ends)]:
        figure = draw()
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
                assert not boxes or UNIT.search(axis.get_label_text())


def test_an_unknown_format_is_named_with_those_known(tmp_path):
    with pytest.raises(CaseError, match=r"'bmp7'; use one of .*png"):
        figures.write_figures({}, tmp_path, "bmp7")


@pytest.mark.slow
@pytest.mark.parametrize("suffix", ["pdf", ".svg"])
def test_the_same_result_gives_the_same_file(suffix, tmp_path):
    pictures = {"map": pressure_map(made((0.0,))).figure}
    one, other = (figures.write_figures(pictures, tmp_path / str(i), suffix)[0] for i in range(2))
    assert one.read_bytes() == other.read_bytes()
