"""Contact solvers that are good for the first steps of a run, and bad from then on."""

from dataclasses import replace

import numpy as np
import pytest
from zoo_keeper import Zoo, case_of, expect_harmless, expect_one_message

from tribo import NumericalError, Simulation
from tribo.contact.dcfft import DcFft
from tribo.core.errors import PluginError

ZOO = Zoo()


def bad_later(words):
    return ZOO.bad(words, saved=True)


class Solver(DcFft):
    """Good for 20 solves; `spoilt` is what it answers after them."""

    _solves: object = 0

    def solve(self, problem, start=None):
        self._solves += 1
        solution = super().solve(problem, start)
        return self.spoilt(solution, problem) if self._solves > 20 else solution

    def spoilt(self, solution, problem):
        return replace(solution, **self.changed(solution))

    def changed(self, solution):
        return {}


@bad_later("NoneType instead of a ContactSolution")
class AnswersNothing(Solver):
    def spoilt(self, solution, problem):
        return None


@bad_later("ndarray instead of a ContactSolution")
class AnswersThePressure(Solver):
    def spoilt(self, solution, problem):
        return solution.pressure


@bad_later("a pressure that is not an array of shape (32, 32): float64 of shape (31, 32)")
class WrongShape(Solver):
    def changed(self, solution):
        return {"pressure": solution.pressure[1:]}


@bad_later("a pressure that is not an array of shape (32, 32): complex128")
class ComplexPressure(Solver):
    def changed(self, solution):
        return {"pressure": solution.pressure + 0j}


@bad_later("a pressure that is not finite in 1 cells")
class NotANumber(Solver):
    def changed(self, solution):
        pressure = solution.pressure.copy()
        pressure[3, 4] = np.nan
        return {"pressure": pressure}


@bad_later("a negative pressure (-5")
class Adhesive(Solver):
    def changed(self, solution):
        pressure = solution.pressure.copy()
        pressure[0, 0], pressure[16, 16] = -5.0, pressure[16, 16] + 5.0
        return {"pressure": pressure}


@bad_later("above the hardness of 2e+09 Pa")
class TooHard(Solver):
    def changed(self, solution):
        pressure = np.zeros_like(solution.pressure)
        pressure[16, 16] = solution.pressure.sum()
        return {"pressure": pressure}


@bad_later("carries 100.01 N instead of 100 N")
class TooStrong(Solver):
    def changed(self, solution):
        return {"pressure": 1.0001 * solution.pressure}


@bad_later("an approach that is not a finite number: nan")
class NoApproach(Solver):
    def changed(self, solution):
        return {"approach": np.nan}


@bad_later("an overlap that is not finite in 1024 cells")
class EndlessOverlap(Solver):
    def changed(self, solution):
        return {"overlap": np.full_like(solution.overlap, np.inf)}


@bad_later("an overlap that is not finite in 1 cells")
class OverlapNotANumber(Solver):
    def changed(self, solution):
        overlap = solution.overlap.copy()
        overlap[0, 0] = np.nan
        return {"overlap": overlap}


@bad_later("NoneType instead of Residuals")
class NoResiduals(Solver):
    def changed(self, solution):
        return {"residuals": None}


@bad_later("a residual of force that is not a finite number: nan")
class ResidualNotANumber(Solver):
    def changed(self, solution):
        return {"residuals": replace(solution.residuals, force=np.nan)}


@bad_later("a number of iterations that is not a finite number: a str")
class CountsInWords(Solver):
    def changed(self, solution):
        return {"iterations": "many"}


@bad_later("raised ZeroDivisionError: division by zero")
class Divides(Solver):
    def spoilt(self, solution, problem):
        return 1 / 0


def helper():
    raise LookupError


@bad_later("raised LookupError and says no more")
class FailsInAHelper(Solver):
    def spoilt(self, solution, problem):
        return helper()


@ZOO.bad("raised LookupError")
class FailsInAStaticMethod(Solver):
    @staticmethod
    def solve(problem, start=None):
        return helper()


@bad_later("raised NumericalError")
class SaysNothing(Solver):
    def spoilt(self, solution, problem):
        raise NumericalError


@bad_later("it did not like it")
class GivesUp(Solver):
    def spoilt(self, solution, problem):
        raise NumericalError("it did not like it")


class Unspeakable(Exception):
    def __str__(self):
        raise RuntimeError


@bad_later("raised Unspeakable: (its message cannot be shown)")
class RaisesTheUnspeakable(Solver):
    def spoilt(self, solution, problem):
        raise Unspeakable


@bad_later("raised SystemExit: 0")
class Leaves(Solver):
    def spoilt(self, solution, problem):
        raise SystemExit(0)


@bad_later("read-only")
class WritesIntoTheGap(Solver):
    def spoilt(self, solution, problem):
        problem.gap[:] = 0


@bad_later("read-only")
class WritesIntoTheWear(Solver):
    def spoilt(self, solution, problem):
        problem.wear.local[:] = 0


@bad_later("read-only")
class WritesIntoTheStart(Solver):
    def solve(self, problem, start=None):
        if start is not None:
            start.pressure[:] = 0
        return super().solve(problem, start)


@bad_later("read-only")
class UsesItsAnswerAgain(Solver):
    _kept: object = None

    def solve(self, problem, start=None):
        answer = super().solve(problem, start)
        if start is not None:
            self._kept.pressure[:] = answer.pressure
            return self._kept
        self._kept = answer
        return answer


@ZOO.bad("raised KeyError: 'no'")
class CheckRaises(DcFft):
    def check(self, system):
        raise KeyError("no")


@pytest.mark.parametrize("cls", ZOO.kept, ids=lambda cls: cls.__name__)
def test_it_ends_with_one_message(run, cls):
    expect_one_message(run(ZOO, cls), cls)


def test_none_harms_a_case_that_names_another(run):
    expect_harmless(run(ZOO))


def test_the_smallest_compliance_is_a_number(run):
    zoo = Zoo()

    @zoo.bad("a smallest compliance that is not a finite number: a str")
    class Boastful(DcFft):
        def smallest_compliance(self, system):
            return "tiny"

    expect_one_message(
        run(zoo, Boastful, more='stepping = { type = "explicit", time_step = 1 }'), Boastful
    )


def test_python_is_told_the_same(tmp_path):
    (tmp_path / "case.toml").write_text(case_of(Divides))
    with pytest.raises(PluginError, match=r"zoo\.divides.*ZeroDivisionError"):
        Simulation(tmp_path / "case.toml", ZOO.registry()).run()
