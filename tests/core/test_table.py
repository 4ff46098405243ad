"""Tables describe and print themselves, and a case prints as a tree of what was given."""

import pytest

from tribo import GPa, N, Sphere, load_case, mm
from tribo.core.units import parse, stated


@pytest.mark.parametrize(
    ("given", "unit", "shown"),
    [
        ("207.123456789 GPa", "Pa", "207.123456789 GPa"),
        ("0.3 µm", "m", "300 nm"),
        ("1 mm", "m", "1 mm"),
        ("1.2345678e-6 mm^3/(N m)", "1/Pa", "1.2345678e-15 1/Pa"),
    ],
)
def test_a_value_is_stated_with_the_digits_that_it_was_given(given, unit, shown):
    assert stated(parse(given, unit), unit) == shown


def test_values_without_names_are_refused_in_plain_words():
    with pytest.raises(TypeError, match=r"value of Sphere by its name, as Sphere\(radius=…\)"):
        Sphere(5e-3)


def test_a_case_prints_values_in_readable_units_and_leaves_out_defaults():
    case = load_case("tribo/templates/ball_on_disk.toml").with_values({"grid.cells": 64})
    lines = str(case).splitlines()
    assert lines[0] == "Case"
    assert "  grid: size [2 mm, 2 mm], cells [64, 64]" in lines
    assert "  load: normal 100 N" in lines
    assert "      surface: sphere, radius 5 mm" in lines
    assert not any("stepping" in line for line in lines)
    assert case.bodies["ball"].material.young == 207 * GPa
    assert (case.load.normal, case.bodies["ball"].surface.radius) == (100 * N, 5 * mm)


def test_entries_of_a_list_are_counted_from_1_as_in_a_path():
    stages = [{"until": 60.0, "normal": 50.0}, {"until": 3600.0, "normal": 80.0}]
    case = load_case("tribo/templates/ball_on_disk.toml").with_values({"load.normal": stages})
    lines = [line.strip() for line in str(case).splitlines()]
    assert "1: until 60 s, normal 50 N" in lines
    assert case.with_values({"load.normal.1.normal": 20.0}).load.normal[0].normal == 20 * N
