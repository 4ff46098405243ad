"""No comparison passes by the absolute tolerance that pytest adds by default."""

import pytest


@pytest.mark.parametrize(
    ("expected", "rel"),
    [(1.2e-13, 1e-6), (1e-7, None), (0.0, 1e-6), ([1.0, 1e-15], None), ({"k": 1e-15}, 0.1)],
)
def test_the_default_absolute_tolerance_must_not_decide(expected, rel):
    with pytest.raises(ValueError, match="give rel with abs=0, or abs alone"):
        pytest.approx(expected, rel=rel)


def test_what_is_small_is_compared_by_what_is_said():
    assert pytest.approx(1.2e-13, rel=1e-6, abs=0) != 1.3e-13
    assert pytest.approx(1.0) == 1.0 + 1e-7
