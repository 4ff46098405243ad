"""What the average over a track costs, as the pages on verification and on the paper state it."""

import pytest

from tribo.verification.strokes import _reciprocating


@pytest.mark.parametrize(("stroke", "percent"), [(38, 4), (76, 1)])
def test_the_average_is_too_deep_at_mid_stroke_by_what_the_pages_say(stroke, percent):
    moved, averaged = _reciprocating(stroke, 0.0)["largest depth there, by the average"]
    assert 100 * (averaged / moved - 1) == pytest.approx(percent, abs=0.7)
