"""What a result shows of itself."""

import re

import made_results
import pytest

from tribo import CaseError


@pytest.mark.slow
def test_measures_and_plots_are_a_method_away(monkeypatch, tmp_path):
    made_results.empty_pictures(monkeypatch)
    result = made_results.made()
    assert set(result.report().bodies) == {"ball", "disk"}
    assert {path.name for path in result.plot(tmp_path)} >= {"pressure_map.png", "wear_history.png"}


def test_a_notebook_shows_the_lab_table_and_a_picture(monkeypatch):
    # As every Jupyter kernel does.
    monkeypatch.setenv("FORCE_COLOR", "1")
    shown = made_results.made()._repr_html_()
    assert "\x1b" not in shown
    assert "specific wear rate" in shown
    assert 'src="data:image/png;base64,' in shown
    heights = [int(px) for px in re.findall(r"height:(\d+)px", shown)]
    assert len(heights) == 2
    assert sum(heights) < 600


def test_a_misspelt_variable_is_not_called_damage():
    result = made_results.made()
    with pytest.raises(CaseError, match="did you mean 'pressure'"):
        result.field("presure", -1)
    with pytest.raises(AttributeError, match="did you mean 'pressure'"):
        result.presure  # noqa: B018
