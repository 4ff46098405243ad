"""The contact temperature of the paper's test, and what the effect refuses."""

from dataclasses import replace

import numpy as np
import pytest
from greens_function import moved_on, steady_cycle, to_and_fro
from tribo import CaseError, ContactConditions, ContactSystem, Grid, Material

from tribo_thermal.flash import Flash

STEEL = {"young": "207 GPa", "poisson": 0.3}
HEAT = {"conductivity": "46 W/(m K)", "density": "7850 kg/m^3", "heat_capacity": "460 J/(kg K)"}
FRESH, WORN = 148.837e-6, 530e-6
MOVING, RESTING = {"ball": 0.0, "disk": 1.0}, {"ball": 1.0, "disk": 0.0}


def contact(radius, swept=("disk",), material=None, load=100.0):
    """Hertz's pressure under 100 N over a given radius, sliding at 0.1 m/s."""
    cells = 128
    grid = Grid((2.4 * radius, 2.4 * radius), (cells, cells))
    x, y = grid.mesh
    pressure = np.sqrt(np.maximum(1 - (x**2 + y**2) / radius**2, 0.0))
    pressure *= load / (np.sum(pressure) * grid.cell_area)
    steel = Material(**STEEL, **(HEAT if material is None else material))
    friction = np.full(grid.cells, 0.1)
    return ContactConditions(
        system=ContactSystem(grid, 1e11, load, materials={"ball": steel, "disk": steel}),
        pressure=pressure,
        speed=0.1,
        time=1.0,
        distance=0.1,
        swept=frozenset(swept),
        fields={"friction_coefficient": {"ball": friction, "disk": friction}},
    )


def rises(where, **config):
    given = {"ambient": "90 degC", "source": "parabolic", "rise": "maximum", **config}
    effect = Flash(**given)
    # As when a case is composed, before anything runs.
    effect.check(where.system, where.swept, "dcfft")
    return effect.rises(where)


def test_to_and_fro_the_swept_body_alone_is_hotter_as_by_greens_function():
    once = contact(WORN)
    again = replace(once, track=2e-3, turns_back=True)
    taken = {
        name: rises(again, rise="mean", heat_fraction=part)[name]
        / rises(once, rise="mean", heat_fraction=part)[name]
        for name, part in (("disk", MOVING), ("ball", RESTING))
    }
    peclet = 0.1 * WORN * 7850 * 460 / (2 * 46)
    needed = steady_cycle(to_and_fro, 2e-3 / WORN, peclet) / moved_on(peclet)
    # Both of a Hertzian flux, of which the joined formula has its error.
    assert taken["disk"] == pytest.approx(needed, rel=0.05)
    assert needed > 1.6
    assert taken["ball"] == 1


def test_partition_is_bloks_and_gives_one_temperature():
    where = contact(FRESH)
    one = rises(where, heat_fraction=MOVING)["disk"]
    other = rises(where, heat_fraction=RESTING)["ball"]
    both = rises(where)
    assert both["ball"] == both["disk"]
    assert 1 / both["ball"] == pytest.approx(1 / one + 1 / other, rel=1e-12, abs=0)


def test_nothing_is_warmed_where_nothing_touches():
    assert rises(contact(WORN, load=0.0)) == {"ball": 0.0, "disk": 0.0}


@pytest.mark.parametrize("missing", ["density", "heat_capacity"])
def test_a_missing_property_is_named_with_its_place(missing):
    material = {key: value for key, value in HEAT.items() if key != missing}
    with pytest.raises(CaseError, match=rf"bodies\.disk\.material\.{missing}"):
        rises(contact(WORN, material=material))


def test_a_resting_source_needs_no_heat_capacity():
    assert rises(contact(WORN, swept=(), material={"conductivity": "46 W/(m K)"}))["ball"] > 0


def test_two_swept_bodies_are_refused():
    with pytest.raises(CaseError, match="all bodies are swept"):
        rises(contact(WORN, swept=("ball", "disk")))


@pytest.mark.parametrize(
    "wrong",
    [
        {"heat_fraction": {"ball": 1.0}},
        {"heat_paths": {"pin": {"length": "1 mm", "area": "1 mm^2"}}},
    ],
)
def test_bodies_that_do_not_exist_are_refused(wrong):
    with pytest.raises(CaseError, match="the bodies are ball, disk"):
        rises(contact(WORN), **wrong)


def test_all_the_heat_must_go_somewhere():
    with pytest.raises(CaseError, match="all the heat is 1"):
        Flash(ambient=363.15, heat_fraction={"ball": 0.5, "disk": 0.4})
