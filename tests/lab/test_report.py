"""The numbers a lab would report, in one place."""

import numpy as np
import pytest
from made_results import half_width, made
from paper_models import archard, case, flat, motion, named, steel

from tribo import Grid, Simulation
from tribo.closed_forms.hertz import first_yield_pressure
from tribo.core.contact import ContactSystem
from tribo.lab.against_hertz import hertz_contact
from tribo.lab.report import lab_report
from tribo.surfaces.forms import Cylinder, Sphere

H = 4e9


def test_the_lab_block_is_that_of_the_worn_bodies():
    # made() wears 3.11e-14 m³ per m of sliding at 100 N.
    report = lab_report(made(densities=(7850.0, None), cap=H))
    lab = report.as_json()
    ball, disk = lab["bodies"]["ball"], lab["bodies"]["disk"]
    assert ball["specific_wear_rate_mm3_per_Nm"] == pytest.approx(3.11e-7, rel=1e-6, abs=0)
    assert ball["mass_kg"] == pytest.approx(7850 * 3.11e-14 * 360, rel=1e-6, abs=0)
    # To a twentieth of a cell of 40 µm.
    assert ball["scar_along_m"] == pytest.approx(2 * half_width(3600), abs=2e-6)
    assert disk["mass_kg"] is disk["scar_along_m"] is None
    for body in (ball, disk):
        assert body["scar_across_m"] == pytest.approx(2.2 * half_width(3600), abs=2e-6)


def test_the_first_contact_is_the_computed_one_beside_hertz():
    result = made(cap=H)
    first = lab_report(result).as_json()["first_contact"]
    assert first["hertz_peak_pressure_Pa"] == pytest.approx(2.155e9, rel=1e-3)
    assert first["max_pressure_Pa"] == result.field("pressure", 0).max()
    assert first["yield_ratio"] == first["max_pressure_Pa"] / first_yield_pressure(H)


def test_what_is_not_known_is_null():
    lab = lab_report(made(times=(0.0,), cap=None)).as_json()
    assert lab["bodies"]["ball"]["specific_wear_rate_mm3_per_Nm"] is None
    assert lab["bodies"]["ball"]["scar_across_m"] == 0
    assert lab["first_contact"]["yield_ratio"] is None
    first = lab_report(made(cap=H, curvature=None)).first_contact
    assert first.hertz_peak_pressure_Pa is first.yield_ratio is first.load_ratio is None


@pytest.mark.parametrize("line", [False, True])
def test_the_load_is_set_against_that_of_first_yield(line):
    radius, modulus, length = 1e-2, 1e11, 2e-3
    peak = first_yield_pressure(H, line=line)
    # Johnson (1985), section 4.2: P' = π p0² R/E* a length; P = π³ p0³ R²/6E*².
    onset = (
        np.pi * peak**2 * radius / modulus * length
        if line
        else np.pi**3 * peak**3 * radius**2 / (6 * modulus**2)
    )
    curvature = 1 / radius, 0.0 if line else 1 / radius
    grid = Grid((1e-3, length), (4, 4))
    contact = hertz_contact(ContactSystem(grid, modulus, 3 * onset, H, curvature))
    assert contact.load_ratio == pytest.approx(3)


def test_the_ends_of_a_line_contact_do_not_count_towards_its_yield():
    roller = case(
        grid=Grid((0.4e-3, 2e-3), (40, 40)),
        ends_at_window=True,
        load=200,
        bodies=[
            named("roller", Cylinder(radius="5 mm"), steel(hardness=H), archard()),
            named("disk", flat(), steel(hardness=H), archard()),
        ],
        kinematics=motion(stroke="4 mm", duration=0.1),
    )
    lab = lab_report(Simulation(roller).run())
    first = lab.first_contact
    # The half-space bears more near the ends than Hertz's even load per length.
    assert first.yield_ratio == pytest.approx(0.31, abs=0.01)
    assert first.max_pressure_Pa > 1.4 * first.hertz_peak_pressure_Pa
    assert (
        f"at mid-length, {1e-6 * first.max_pressure_Pa:.1f} MPa at most" in lab.first_contact_words
    )


def test_a_line_contact_yields_at_its_own_factor():
    # Johnson (1985), section 6.1: von Mises' stress of a Hertzian line, in plane strain.
    z = np.linspace(0.01, 3, 3000)
    across, down = 2 * z - (1 + 2 * z**2) / np.hypot(1, z), -1 / np.hypot(1, z)
    along = 0.3 * (across + down)
    pairs = (across - down, down - along, along - across)
    mises = np.sqrt(0.5 * sum(difference**2 for difference in pairs))
    onset = H / 2.8 / np.max(mises)
    assert first_yield_pressure(H, line=True) == pytest.approx(onset, rel=3e-3)


def test_no_yield_is_reported_where_a_body_has_no_hardness():
    # Of one body of PEEK, say, by its name, which has none.
    bodies = [
        named("ball", Sphere(radius="5 mm"), steel(), archard()),
        named("disk", flat(), steel(hardness=H), archard()),
    ]
    first = lab_report(Simulation(case(bodies=bodies, kinematics=motion(duration=0.1))).run())
    assert first.first_contact.yield_ratio is first.first_contact.load_ratio is None
    assert "yield" not in first.first_contact_words
