"""A case prints as a tree of what was given."""

from tribo import GPa, N, load_case, mm


def test_a_case_prints_values_in_readable_units_and_leaves_out_defaults():
    case = load_case("examples/ball_on_disk.toml").with_values({"grid.cells": 64})
    lines = str(case).splitlines()
    assert lines[0] == "Case"
    assert "  grid: size [2 mm, 2 mm], cells [64, 64]" in lines
    assert "  load: normal 100 N" in lines
    assert "      surface: sphere, radius 5 mm" in lines
    assert not any("stepping" in line for line in lines)
    assert case.bodies["ball"].material.young == 207 * GPa
    assert (case.load.normal, case.bodies["ball"].surface.radius) == (100 * N, 5 * mm)
