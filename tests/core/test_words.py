"""Numbers in words and tables."""

import numpy as np
import pytest

from tribo.core.words import did_you_mean, plus_minus, readable


@pytest.mark.parametrize("form", [".0f", ".1f", ".2f", ".3f", ".3g"])
def test_what_is_small_is_told_to_a_twentieth(form):
    for value in np.geomspace(1e-12, 1e6, 400):
        assert float(readable(value, form)) == pytest.approx(value, rel=0.051, abs=0)
        assert float(readable(-value, form)) == pytest.approx(-value, rel=0.051, abs=0)


def test_below_a_million_a_number_is_written_out():
    assert [readable(value, ".3g") for value in (1263.0, 12.5e3, 2e6)] == ["1260", "12500", "2e+06"]


@pytest.mark.parametrize(
    ("name", "known", "meant"),
    [
        ("hz", ["h", "Hz"], "Hz"),
        ("flash", ["flat", "thermal.flash"], "thermal.flash"),
        ("frequncy", ["stroke", "frequency"], "frequency"),
        ("stroke", ["load", "cells"], None),
        (3, ["3"], None),
    ],
)
def test_the_same_but_for_capitals_or_a_prefix_is_meant_before_the_nearly_same(name, known, meant):
    assert did_you_mean(name, known) == meant


def test_an_uncertainty_has_two_digits_and_its_value_as_many_decimals():
    assert plus_minus(36.6812, 0.8123) == ("36.68", "0.81")
    assert plus_minus(1234.5, 56.7) == ("1234", "57")
    assert plus_minus(36.6812, 1e-9) == ("36.6812", "1e-09")
