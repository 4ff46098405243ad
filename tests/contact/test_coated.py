"""Coated half-spaces: closed forms, and the limits of a coating."""

from dataclasses import replace

import numpy as np
import pytest

from tribo import CaseError, HalfSpace, Periodic, Winkler, residuals
from tribo.contact.coated import base_kernel
from tribo.contact.dcfft import DcFft
from tribo.contact.periodic import PeriodicHalfSpace
from tribo.core.coating import Coating
from tribo.core.contact import ContactProblem, ContactSystem
from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.lab.against_hertz import hertz_contact

H = 20e-6
SOFT = Material(young=100e9, poisson=0.3)
STIFF = Material(young=300e9, poisson=0.2)
RIGID = Material(young=1e20, poisson=0.3)
PAIRS = [(SOFT, STIFF), (STIFF, SOFT), (SOFT, RIGID)]


def modulus(material):
    return material.young / (1 - material.poisson**2)


def wave(xi, layer, base):
    """Displacement of a coated half-space under a pressure wave over that of the layer alone.

    Plane strain: the stress function [(a + bz) e^−qz + (c + dz) e^qz] cos qx in
    the layer and [(e + fz) e^−qz] cos qx in the base meet six conditions.
    """

    # With z in units of 1/q: stresses −F and F', displacements by Hooke's law.
    def terms(z, material):
        nu, two_g = material.poisson, material.young / (1 + material.poisson)
        rows = []
        for sign in (-1.0, 1.0):
            grown = np.exp(sign * z)
            plain = (grown, sign * grown, grown, sign * grown)
            times_z = [(n * sign ** (n + 1) + z * sign**n) * grown for n in range(4)]
            for f, f1, f2, f3 in (plain, times_z):
                across = ((1 - nu) * f2 + nu * f) / two_g
                down = ((1 - nu) * f3 - (2 - nu) * f1) / two_g
                rows.append((-f, f1, across, down))
        return np.array(rows).T

    top, under, base_top = terms(0.0, layer), terms(xi, layer), terms(0.0, base)[:, :2]
    matrix = np.zeros((6, 6))
    matrix[:2, :4] = top[:2]
    matrix[2:, :4], matrix[2:, 4:] = under, -base_top
    scale = np.array([1, 1, 1, 1, layer.young, layer.young])
    a = np.linalg.solve(matrix * scale[:, None], [-1.0, 0, 0, 0, 0, 0])
    return top[3] @ a[:4] * modulus(layer) / 2


@pytest.mark.parametrize(("layer", "base"), [*PAIRS, (SOFT, SOFT)])
def test_the_influence_is_that_of_elasticity(layer, base):
    xi = np.array([0.05, 0.3, 1.0, 2.5])
    expected = [wave(x, layer, base) for x in xi]
    np.testing.assert_allclose(1 + Coating(H, layer, base).influence(xi / H), expected, rtol=1e-6)


def test_a_large_cell_is_the_sum_of_small_ones():
    # Beyond a layer as thin as these, three points of Gauss's rule would miss the load.
    coating = Coating(0.5, SOFT, STIFF)
    large = base_kernel((8, 8), (5.0, 3.0), [coating])
    small = base_kernel((64, 64), (1.0, 0.6), [coating])
    for i, j in ((0, 0), (1, 0), (0, 2), (2, 1)):
        rows, columns = 5 * i + np.arange(-2, 3), 5 * j + np.arange(-2, 3)
        assert large[i, j] == pytest.approx(np.sum(small[np.ix_(rows, columns)]), rel=1e-5, abs=0)


def test_a_coating_of_the_base_is_no_coating():
    plain = HalfSpace((24, 30), (5e-6, 4e-6), modulus(SOFT))
    coated = HalfSpace((24, 30), (5e-6, 4e-6), modulus(SOFT), (Coating(H, SOFT, SOFT),))
    pressure = np.random.default_rng(1).random((24, 30))
    np.testing.assert_array_equal(coated.apply(pressure), plain.apply(pressure))


def system(grid, load, **coatings):
    """A rigid ball on a coated base."""
    base = next(iter(coatings.values())).base
    return ContactSystem(grid, modulus(base), load, coatings=coatings)


def ball(coating, load, width, cells=48, radius=1e-3):
    grid = Grid((width, width), (cells, cells))
    x, y = grid.mesh
    return ContactProblem(system(grid, load, disk=coating), (x**2 + y**2) / (2 * radius), load)


@pytest.mark.parametrize("poisson", [0.3, 0.499])
def test_the_box_of_the_contact_sees_what_the_whole_window_does(poisson):
    # A nearly incompressible layer rises beside the contact.
    rubber = Material(young=1e6, poisson=poisson)
    problem = ball(Coating(H, rubber, RIGID), 1e-4, 0.4e-3, cells=64)
    found = DcFft(tolerance=1e-11).solve(problem)
    assert np.ptp(np.nonzero(found.pressure)[0]) < 40
    system = problem.system
    whole = HalfSpace(
        system.grid.cells,
        system.grid.spacing,
        system.surface_modulus,
        tuple(system.coatings.values()),
    )
    displacement = whole.apply(found.pressure)
    cap, total = np.inf, problem.load / system.grid.cell_area
    judged = residuals(found.pressure, problem.gap, displacement, found.approach, total, cap)
    assert judged.worst < 1e-9


def test_two_coated_bodies_add_their_compliances():
    one, other = Coating(H, SOFT, STIFF), Coating(2 * H, STIFF, SOFT)
    grid = Grid((64e-6, 64e-6), (16, 16))
    bases = 1 / (1 / modulus(STIFF) + 1 / modulus(SOFT))
    both = ContactSystem(grid, bases, 1.0, coatings={"ball": one, "disk": other})
    pressure = np.random.default_rng(2).random(grid.cells)
    parts = [
        HalfSpace(grid.cells, grid.spacing, each.modulus, (each,)).apply(pressure)
        for each in (one, other)
    ]
    joint = HalfSpace(grid.cells, grid.spacing, both.surface_modulus, (one, other))
    np.testing.assert_allclose(joint.apply(pressure), sum(parts), rtol=1e-12)


@pytest.mark.parametrize("solver", [DcFft(), Periodic()])
def test_the_smallest_compliance_is_below_that_of_every_mode(solver):
    grid = Grid((64e-6, 64e-6), (12, 12))
    for coating in (Coating(1e-6, SOFT, STIFF), Coating(1e-6, STIFF, SOFT)):
        asked = system(grid, 1.0, disk=coating)
        smallest = solver.smallest_compliance(asked)
        kind = PeriodicHalfSpace if solver.periodic else HalfSpace
        operator = kind(grid.cells, grid.spacing, asked.surface_modulus, (coating,))
        unit = np.eye(144).reshape(144, 12, 12)
        dense = np.array([operator.apply(each).ravel() for each in unit])
        least = np.sort(np.linalg.eigvalsh(dense))[1 if solver.periodic else 0]
        assert 0.3 * least < smallest < 1.0001 * least


def test_hertz_and_a_foundation_matched_to_him_know_no_coating():
    grid = Grid((64e-6, 64e-6), (12, 12))
    asked = replace(system(grid, 1.0, disk=Coating(H, SOFT, STIFF)), curvature=(1e3, 1e3))
    assert hertz_contact(asked) is None
    with pytest.raises(CaseError, match="knows no elastic layer; give modulus or layer"):
        Winkler().check(asked)
    Winkler(modulus=1e15).check(asked)
