"""The pressures tamaas finds: those of `dcfft`, judged, warm or cold, in any units."""

from dataclasses import replace

import numpy as np
import pytest
from tribo import (
    CaseError,
    ContactProblem,
    ContactSystem,
    Grid,
    NumericalError,
    WearCompliance,
)

from tribo_tamaas import Tamaas

tamaas = pytest.importorskip(
    "tamaas", reason="tamaas is not installed: it has wheels for Linux on x86-64 only"
)

MODULUS = 207e9 / (2 * (1 - 0.3**2))


def ball(cells=(48, 48), size=(0.7e-3, 0.7e-3), load=100.0, cap=None, modulus=MODULUS):
    grid = Grid(size, cells)
    x, y = grid.mesh
    gap = (x**2 + y**2) / 10e-3
    return ContactProblem(ContactSystem(grid, modulus, load, cap), gap, load)


@pytest.mark.parametrize("cap", [None, 4e9])
@pytest.mark.parametrize(
    ("cells", "size"), [((65, 48), (1.2e-3, 1.2e-3)), ((48, 96), (1.2e-3, 3.6e-3))]
)
def test_window_and_cells_need_not_be_square_or_even(cells, size, cap):
    problem = ball(cells, size, 1000.0, cap)
    solution = Tamaas().solve(problem)
    assert solution.residuals.worst <= 1e-8
    assert solution.iterations > 0
    at_cap = np.count_nonzero(solution.pressure == 4e9) * problem.system.grid.cell_area
    # Converged on fine grids; cells are counted whole.
    assert at_cap == pytest.approx(0 if cap is None else 0.124e-6, rel=0.03, abs=0)


@pytest.mark.parametrize("cap", [None, 4e9])
def test_not_converging_is_an_error_with_the_residual(cap, capfd):
    problem = ball(size=(1.2e-3, 1.2e-3), load=1000.0, cap=cap)
    with pytest.raises(NumericalError, match=r"in \d+ iterations: the residual is .*tolerance 1"):
        Tamaas(max_iterations=3).solve(problem)
    # Tamaas prints of itself.
    assert capfd.readouterr() == ("", "")


def test_tamaas_left_periodic_would_be_noticed(monkeypatch):
    # It stays so, without a word, when setIntegralOperator is forgotten.
    monkeypatch.setattr(tamaas.PolonskyKeerRey, "setIntegralOperator", lambda *_: None)
    with pytest.raises(NumericalError, match="residual"):
        Tamaas().solve(ball())


def test_it_refuses_what_it_cannot_solve():
    problem = ball()
    wear = WearCompliance(np.zeros((48, 48)), np.zeros(48))
    with pytest.raises(CaseError, match="takes no wear compliance"):
        Tamaas().solve(replace(problem, wear=wear))
    problem.gap[3, 4] = np.nan
    with pytest.raises(NumericalError, match="not finite"):
        Tamaas().solve(problem)


@pytest.mark.parametrize("call", ["check", "solve"])
def test_load_that_the_window_cannot_bear_is_an_error(call):
    problem = ball(load=3000.0, cap=4e9)
    with pytest.raises(CaseError, match=r"bears no more than 1960 N; enlarge grid\.size"):
        Tamaas().check(problem.system) if call == "check" else Tamaas().solve(problem)
