"""A layered half-space as a kernel, against its limits and an independent solution."""

import numpy as np
import pytest
from strangers import layered
from strangers.layered import Layered, LayeredHalfSpace

from tribo import CaseError, HalfSpace, Registry, Simulation, solve_bounded

H = 20e-6
SOFT = {"young": 100e9, "poisson": 0.3}
STIFF = {"young": 300e9, "poisson": 0.2}


def config(layer, base, thickness=H):
    under = {f"base_{key}": value for key, value in base.items()}
    return Layered(thickness=thickness, **layer, **under)


def wave(xi, layer, base):
    """Displacement of a layered half-space under a pressure wave over that of the layer alone.

    Plane strain: the stress function [(a + bz) e^−qz + (c + dz) e^qz] cos qx in
    the layer and [(e + fz) e^−qz] cos qx in the base meet six conditions.
    """

    # With z in units of 1/q: stresses −F and F', displacements by Hooke's law.
    def terms(z, material):
        nu = material["poisson"]
        two_g = material["young"] / (1 + nu)
        rows = []
        for sign in (-1.0, 1.0):
            grown = np.exp(sign * z)
            for f, f1, f2, f3 in (
                (grown, sign * grown, grown, sign * grown),
                (
                    z * grown,
                    (1 + sign * z) * grown,
                    (2 * sign + z) * grown,
                    (3 + sign * z) * grown,
                ),
            ):
                sigma, tau = -f, f1
                across = ((1 - nu) * f2 + nu * f) / two_g
                down = ((1 - nu) * f3 - (2 - nu) * f1) / two_g
                rows.append((sigma, tau, across, down))
        return np.array(rows).T

    top, under, base_top = terms(0.0, layer), terms(xi, layer), terms(0.0, base)[:, :2]
    matrix = np.zeros((6, 6))
    matrix[:2, :4] = top[:2]
    matrix[2:, :4], matrix[2:, 4:] = under, -base_top
    scale = np.array([1, 1, 1, 1, layer["young"], layer["young"]])
    a = np.linalg.solve(matrix * scale[:, None], [-1.0, 0, 0, 0, 0, 0])
    alone = 2 * (1 - layer["poisson"] ** 2) / layer["young"]
    return top[3] @ a[:4] / alone


PAIRS = [(SOFT, STIFF), (STIFF, SOFT), (SOFT, SOFT), (SOFT, {"young": 1e20, "poisson": 0.3})]


@pytest.mark.parametrize(("layer", "base"), PAIRS)
def test_the_kernel_is_that_of_elasticity(layer, base):
    xi = np.array([0.05, 0.3, 1.0, 2.5])
    expected = [wave(x, layer, base) for x in xi]
    np.testing.assert_allclose(1 + config(layer, base).influence(xi), expected, rtol=1e-6)


def bell(operator, width):
    nx, ny = operator.shape
    x = (np.arange(nx) - nx // 2) * operator.spacing[0]
    y = (np.arange(ny) - ny // 2) * operator.spacing[1]
    pressure = np.exp(-(x[:, None] ** 2 + y[None, :] ** 2) / (2 * width**2))
    return operator.apply(pressure)[nx // 2, ny // 2]


@pytest.mark.parametrize(("layer", "base"), PAIRS[:2])
@pytest.mark.parametrize("width", [0.5 * H, 2 * H])
def test_under_a_bell_of_pressure_it_is_the_hankel_transform(layer, base, width):
    # u(0) = ∫ C(q) w² exp(−q²w²/2) q dq; cells of a quarter of the width are good for 0.4 %.
    given = config(layer, base)
    q = np.linspace(0, 12 / width, 20001)[1:]
    exact = np.trapezoid(given.compliance(q) * width**2 * np.exp(-((q * width) ** 2) / 2) * q, q)
    # The integrand is finite at q = 0, where the grid of q begins one step late.
    exact += q[0] * given.compliance(q[:1])[0] * width**2 * q[0]
    operator = LayeredHalfSpace((64, 64), (width / 4, width / 4), given)
    assert bell(operator, width) == pytest.approx(exact, rel=4e-3, abs=0)


def test_with_one_material_it_is_a_half_space():
    operator = LayeredHalfSpace((24, 30), (5e-6, 4e-6), config(SOFT, SOFT))
    plain = HalfSpace((24, 30), (5e-6, 4e-6), config(SOFT, SOFT).modulus)
    pressure = np.random.default_rng(1).random((24, 30))
    np.testing.assert_allclose(operator.apply(pressure), plain.apply(pressure), rtol=1e-12)


def indented(operator, radius=5e-3, load=2.0):
    nx, ny = operator.shape
    x = (np.arange(nx) - 0.5 * (nx - 1)) * operator.spacing[0]
    y = (np.arange(ny) - 0.5 * (ny - 1)) * operator.spacing[1]
    return solve_bounded(operator, (x[:, None] ** 2 + y[None, :] ** 2) / (2 * radius), load)


def test_a_thick_layer_is_a_half_space():
    # What the base does is then all but the same everywhere in the contact.
    shape, spacing = (48, 48), (4e-6, 4e-6)
    plain = indented(HalfSpace(shape, spacing, config(SOFT, STIFF).modulus)).pressure
    differences = []
    for thickness in (0.2e-3, 0.4e-3, 0.8e-3):
        operator = LayeredHalfSpace(shape, spacing, config(SOFT, STIFF, thickness))
        differences.append(np.max(np.abs(indented(operator).pressure - plain)) / plain.max())
    assert differences[-1] < 1e-3
    # Only how its effect varies over the contact counts: that falls with the thickness cubed.
    assert np.all(np.divide(differences[:-1], differences[1:]) > 7)


def test_a_thin_layer_on_a_rigid_base_is_a_foundation():
    # Pressure over depth is E (1 − ν)/((1 + ν)(1 − 2ν) h) where nothing can spread sideways.
    given = config(SOFT, {"young": 1e20, "poisson": 0.3})
    nu = given.poisson
    modulus = given.young * (1 - nu) / ((1 + nu) * (1 - 2 * nu) * H)
    operator = LayeredHalfSpace((96, 96), (H / 4, H / 4), given)
    pressure = np.zeros((96, 96))
    pressure[8:88, 8:88] = 1e9
    depth = operator.apply(pressure)[48, 48]
    assert 1e9 / depth == pytest.approx(modulus, rel=1e-4)


STEEL = {"young": STIFF["young"], "poisson": STIFF["poisson"]}
WEAR = {"type": "archard", "k": "1e-15 1/Pa"}
CASE = {
    "grid": {"size": "0.5 mm", "cells": 40},
    "load": {"normal": "20 N"},
    "bodies": {
        "ball": {
            "surface": {"type": "sphere", "radius": "5 mm"},
            "material": STEEL,
            "wear": WEAR,
        },
        "disk": {"surface": {"type": "flat"}, "material": STEEL, "wear": WEAR},
    },
    "contact": {
        "type": "stranger.layered",
        "thickness": "20 um",
        **SOFT,
        "base_young": STIFF["young"],
        "base_poisson": STIFF["poisson"],
    },
    "kinematics": {
        "type": "reciprocating",
        "stroke": "4 mm",
        "frequency": "12.5 Hz",
        "positions": "average",
        "duration": "60 s",
    },
}


@pytest.fixture(scope="module")
def registry():
    return Registry.with_plugins(layered)


def test_it_wears_under_implicit_steps(registry):
    with Simulation(CASE, registry=registry).run() as result:
        first, *_, end = result.saves()
    for body in end["bodies"].values():
        assert body["wear_volume_m3"] == pytest.approx(
            1e-15 * 20 * end["distance_m"], rel=1e-6, abs=0
        )
    assert end["max_pressure_Pa"] < 0.5 * first["max_pressure_Pa"]


@pytest.mark.filterwarnings("ignore:lap:tribo.TriboWarning")
def test_the_first_contact_lies_between_those_without_layer_and_all_of_layer(registry):
    def peak(contact, disk):
        bodies = {**CASE["bodies"], "disk": {**CASE["bodies"]["disk"], "material": disk}}
        kinematics = {**CASE["kinematics"], "duration": "0.01 s"}
        case = {**CASE, "contact": contact, "bodies": bodies, "kinematics": kinematics}
        with Simulation(case, registry=registry).run() as result:
            return result.saves()[0]["max_pressure_Pa"]

    layer = peak(CASE["contact"], STEEL)
    assert 1.2 * peak({"type": "dcfft"}, SOFT) < layer < 0.95 * peak({"type": "dcfft"}, STEEL)


def test_a_base_softer_than_the_bodies_is_refused(registry):
    contact = {**CASE["contact"], "base_young": "10 GPa"}
    with pytest.raises(CaseError, match=r"^contact: the bodies have a contact modulus of"):
        Simulation({**CASE, "contact": contact}, registry=registry)
