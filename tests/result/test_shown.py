"""What a result shows of itself."""

import re

import made_results
import pytest

from tribo import CaseError
from tribo.result.quantity import quantity


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


@pytest.mark.parametrize(("name", "body"), [("height", "ball"), ("x", None), ("density", "ball")])
def test_what_is_not_saved_each_time_is_no_field(name, body):
    with (
        made_results.made(times=(0.0, 1.0)) as result,
        pytest.raises(CaseError, match=f"^{name} has no value of its own at each save"),
    ):
        quantity(result, name, body)


def test_a_number_of_each_save_has_no_places():
    with made_results.made() as result, pytest.raises(CaseError, match="leave out the places"):
        quantity(result, "max_pressure", places=[(0.0, 0.0)])
