"""The contact temperature of the paper's test, and what the effect refuses."""

from dataclasses import replace

import numpy as np
import pytest
from tribo import CaseError, ContactConditions, ContactSystem, Grid, Material

from tribo_thermal.flash import Flash

STEEL = {"young": "207 GPa", "poisson": 0.3}
HEAT = {"conductivity": "46 W/(m K)", "density": "7850 kg/m^3", "heat_capacity": "460 J/(kg K)"}
FRESH, WORN = 148.837e-6, 530e-6
PATH = {"length": "1 mm", "area": "1 mm^2"}
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


def flash(**config):
    return Flash(**{"ambient": "90 degC", "source": "parabolic", "rise": "maximum", **config})


def rises(where, **config):
    effect = flash(**config)
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
    # As in the case thermal_tracks, over 3.77 radii at Pe 2.08; here both are of a Hertzian flux,
    # of which the joined formula has its error.
    assert taken["disk"] == pytest.approx(1.64974, rel=0.05)
    assert taken["ball"] == 1


def test_partition_is_bloks_and_gives_one_temperature():
    where = contact(FRESH)
    one = rises(where, heat_fraction=MOVING)["disk"]
    other = rises(where, heat_fraction=RESTING)["ball"]
    both = rises(where)
    assert both["ball"] == both["disk"]
    assert 1 / both["ball"] == pytest.approx(1 / one + 1 / other, rel=1e-12, abs=0)


def test_a_bulk_that_warms_no_more_is_as_hot_as_without_a_capacity():
    effect, where = flash(heat_paths={"ball": {**PATH, "capacity": 5}}), contact(FRESH)

    def after(bulk):
        return replace(where, state={"bulk_rise_ball": np.full((1, 1), bulk)})

    cold, warm = (effect.state_rates(after(bulk))["bulk_rise_ball"].item() for bulk in (0.0, 1.0))
    settled = effect.rises(after(cold / (cold - warm)))
    assert settled == pytest.approx(rises(where, heat_paths={"ball": PATH}), rel=1e-9, abs=0)


def test_nothing_is_warmed_where_nothing_touches():
    assert rises(contact(WORN, load=0.0)) == {"ball": 0.0, "disk": 0.0}


@pytest.mark.parametrize("missing", ["density", "heat_capacity"])
def test_a_missing_property_is_named_with_its_place(missing):
    material = {key: value for key, value in HEAT.items() if key != missing}
    with pytest.raises(CaseError, match=rf"bodies\.disk\.material\.{missing}"):
        rises(contact(WORN, material=material))
    # A source at rest needs neither.
    assert rises(contact(WORN, swept=(), material=material))["ball"] > 0


REFUSED = {
    "all bodies are swept": ({}, ("ball", "disk")),
    "heat_fraction .*the bodies are ball, disk": ({"heat_fraction": {"ball": 1.0}}, ("disk",)),
    "heat_paths .*the bodies are ball, disk": ({"heat_paths": {"pin": PATH}}, ("disk",)),
    "all the heat is 1": ({"heat_fraction": {"ball": 0.5, "disk": 0.4}}, ("disk",)),
    "a capacity needs a length": (
        {"heat_paths": {"ball": {**PATH, "length": 0, "capacity": 5}}},
        ("disk",),
    ),
}


@pytest.mark.parametrize("words", REFUSED)
def test_heat_that_cannot_go_where_it_is_sent_is_refused(words):
    config, swept = REFUSED[words]
    with pytest.raises(CaseError, match=words):
        rises(contact(WORN, swept=swept), **config)
