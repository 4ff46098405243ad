"""In full contact a sinusoid wears off as exp(−k s/K̂); both steppings have their order."""

from typing import Literal

import numpy as np
import pytest
from paper_models import K, archard, flat, motion, small, steel

from tribo.config.stepping import ImplicitConfig
from tribo.core.contact import ContactSolution, Residuals
from tribo.core.grid import Grid
from tribo.interfaces.contact import ContactSolver, ContactSolverConfig
from tribo.interfaces.surface import Surface, SurfaceConfig
from tribo.simulation.model import Body
from tribo.simulation.step import explicit_step, first_contact, implicit_step
from tribo.testing.reference.sinusoid import compliance, worn_amplitude

WAVELENGTH = 1e-4
GRID = Grid((4e-4, 4e-4), (32, 32))


class FullContactConfig(ContactSolverConfig):
    type: Literal["test.full-contact"] = "test.full-contact"


class FullContact(ContactSolver[FullContactConfig]):
    """A periodic half-space in full contact: one division in Fourier space."""

    Config = FullContactConfig
    accepts_wear_compliance = True

    def solve(self, problem, start=None):
        grid = problem.system.grid
        q = (
            2
            * np.pi
            * np.hypot(
                np.fft.fftfreq(grid.cells[0], grid.spacing[0])[:, None],
                np.fft.fftfreq(grid.cells[1], grid.spacing[1])[None, :],
            )
        )
        with np.errstate(divide="ignore"):
            symbol = 2 / (problem.system.modulus * q)
        if problem.wear is not None:
            symbol = symbol + problem.wear.local[0, 0]
        modes = -np.fft.fft2(problem.gap) / symbol
        modes[0, 0] = problem.load / grid.cell_area
        pressure = np.fft.ifft2(modes).real
        assert pressure.min() > 0
        return ContactSolution(pressure, 1e-6, np.zeros_like(pressure), 1, Residuals(0.0, 0.0, 0.0))


class WaveConfig(SurfaceConfig):
    type: Literal["test.wave"] = "test.wave"


class Wave(Surface[WaveConfig]):
    Config = WaveConfig

    def height(self, grid):
        wave = 1e-8 * np.cos(2 * np.pi * grid.mesh[0] / WAVELENGTH)
        return np.broadcast_to(wave, grid.cells).copy()


def model():
    return small(
        grid=GRID,
        load=300.0,
        bodies=[Body("wavy", Wave(WaveConfig()), steel(), archard()), Body("b", flat(), steel())],
        contact=FullContact(FullContactConfig()),
        kinematics=motion(),
        ends_at_window=True,
    )


def amplitude_after(step, steps, distance):
    case = model()
    state = first_contact(case)
    for i in range(steps):
        s = distance * (i + 1) / steps
        state = step(case, state, distance / steps, s / 0.1)
    surface = case.bodies[0].surface.height(GRID) - state.bodies["wavy"].wear
    # The wave is sampled beside its crests; relative to its start that cancels.
    return 1e-8 * np.ptp(surface) / np.ptp(case.bodies[0].surface.height(GRID))


def implicit(*args):
    return implicit_step(*args, config=ImplicitConfig()).state


@pytest.mark.parametrize("step", [implicit, explicit_step], ids=["implicit", "explicit"])
def test_a_sinusoid_decays_at_the_exact_rate_with_first_order(step):
    k_hat = compliance(2 * np.pi / WAVELENGTH, model().system.modulus)
    distance = k_hat / K  # one decay length
    exact = 1e-8 * worn_amplitude(distance, K, k_hat)
    errors = np.array([amplitude_after(step, n, distance) / exact - 1 for n in (20, 40, 80)])
    assert abs(errors[-1]) < 0.01
    orders = np.log2(errors[:-1] / errors[1:])
    assert orders == pytest.approx([1.0, 1.0], abs=0.05)
