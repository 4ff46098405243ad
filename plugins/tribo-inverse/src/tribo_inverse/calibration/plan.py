"""The fewest tests that give confidence intervals of a wanted width."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from scipy.special import ndtri, stdtrit
from tribo import Array, Case, CaseError, Finding

from tribo_inverse.calibration.experiment import Experiment
from tribo_inverse.calibration.fit import FEWEST_DEGREES_OF_FREEDOM, check_effect, differenced
from tribo_inverse.calibration.linearised import RIDGE, satterthwaite
from tribo_inverse.calibration.measured import Measurements, read_measurements
from tribo_inverse.calibration.quantities import plain
from tribo_inverse.findings import unresolved

MOST = 1000
"""Largest number of tests that is tried."""


@dataclass(frozen=True, eq=False)
class Plan:
    """The fewest tests of each kind that give intervals of a wanted width.

    Examples
    --------
    >>> from tribo_inverse import plan_tests
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "output={}", "kinematics.duration=2"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> mass = {"body": "ball", "quantity": "mass", "uncertainty": "10 ng"}
    >>> asked = {"measured": [mass], "fit": [{"path": "bodies.ball.wear.k"}], "repeatability": 0.2}
    >>> plan = plan_tests(case, asked, within=0.2)
    >>> int(plan.tests["count"][0]), f"±{plan.parameters['half_width'][0]:.0%}"
    (11, '±19%')
    """

    level: float
    """Confidence level of the intervals."""
    within: float
    """Half-width that was wanted, relative to the value."""
    runs: int
    """Number of simulations."""
    tests: pd.DataFrame
    """One row per kind of test: `test`, its name, and `count`."""
    parameters: pd.DataFrame
    """One row per parameter: `path`; `half_width`, expected of its interval, relative to the value;
    `freedom`, the degrees of freedom of its variance, infinite without scatter from test to
    test."""
    readings: pd.DataFrame
    """One row per entry of `measured`: `test`, `body`, `quantity`, `time_s`, the `computed` value
    of the case, and the `step` of the instrument, in SI."""
    findings: tuple[Finding, ...] = ()
    """Readings that the instrument does not resolve."""

    def as_json(self) -> dict[str, Any]:
        """Return it as plain data."""
        return plain(self) | {"findings": [asdict(each) for each in self.findings]}


def plan_tests(
    case: Case | Mapping[str, Any] | str | Path,
    measured: Measurements | Mapping[str, Any] | str | Path,
    within: float,
    *,
    level: float = 0.95,
    on_run: Callable[[int], object] = id,
) -> Plan:
    """Return the fewest tests that give each parameter an interval of a wanted width.

    Uses the Fisher information at the case's own values, Gᵀ V⁻¹ G with V from the uncertainties
    and the repeatability. Tests are added, and exchanged between kinds, so that the longest
    intervals shrink most (Fedorov 1972, Theory of Optimal Experiments). The intervals are those
    that `calibrate` gives on average when it estimates the repeatability from the tests.

    Parameters
    ----------
    case, level
        As for `calibrate`; the parameters of the case should be realistic.
    measured : Measurements, Mapping, str or Path
        What will be measured, without values, and the repeatability. The entries of `test` are
        the kinds to choose from.
    within : float
        Half-width of the interval that is wanted, relative to the value, as 0.1.
    on_run : callable, optional
        Called after each round of runs with the number of runs.

    Returns
    -------
    Plan
        The number of tests of each kind, and the intervals to expect.

    Raises
    ------
    CaseError, NumericalError
        If the case or the tests are wrong, 1000 are not enough, or a run fails.

    Examples
    --------
    >>> from tribo_inverse import plan_tests
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "output={}", "kinematics.duration=2"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> mass = {"body": "ball", "quantity": "mass", "uncertainty": "10 ng"}
    >>> asked = {"measured": [mass], "fit": [{"path": "bodies.ball.wear.k"}], "repeatability": 0.1}
    >>> plan_tests(case, asked, within=0.2).tests["count"].tolist()  # for k within 20 %
    [8]
    """
    asked = (("level", level, 0.95), ("half-width of the interval", within, 0.1))
    for what, part, example in asked:
        if not 0 < part < 1:
            raise CaseError(f"the {what}, {part:g}, must lie between 0 and 1, as {example} does")
    measurements = read_measurements(measured)
    if measurements.repeatability is None:
        raise CaseError(
            "give the scatter from test to test, as repeatability = 0.2 for 20 %; 0 if only the "
            "instruments count",
            "repeatability",
        )
    experiment = Experiment.of(case, measurements)

    def responses(values: Array) -> Array:
        found = experiment.run(values).responses
        on_run(experiment.run_count)
        return found

    computed = responses(experiment.start)
    problem = experiment.problem(experiment.start)
    point = np.log(experiment.start)
    here = differenced(responses, problem, point, computed)
    here = here.weighed(point, measurements.repeatability)
    check_effect(here)
    sensitivity, kinds = here.jacobian(), []
    for _, own in experiment.data.groupby("setup")["specimen"]:
        rows = own.index[own == own.min()]
        kinds.append(sensitivity[rows].T @ sensitivity[rows])
    search = Search(np.array(kinds), within, level, measurements.repeatability > 0)
    counts = search.fewest()
    halves, freedom = search.expected(counts)
    tests = pd.DataFrame({"test": [setup.name for setup in experiment.setups], "count": counts})
    expected = {"path": list(problem.names), "half_width": halves, "freedom": freedom}
    readings = experiment.data.assign(computed=computed[: len(experiment.data)])
    readings = readings.loc[readings.groupby("place", sort=False)["computed"].idxmax()]
    return Plan(
        level,
        within,
        experiment.run_count,
        tests,
        pd.DataFrame(expected),
        readings[["test", "body", "quantity", "time_s", "computed", "step"]],
        tuple(unresolved(readings)),
    )


@dataclass(frozen=True)
class Search:
    """Search for the fewest tests."""

    kinds: Array
    """Fisher information of one test of each kind, shape (kinds, p, p)."""
    within: float
    """Half-width that is wanted."""
    level: float
    scatters: bool
    """Whether the repeatability is estimated, which costs degrees of freedom."""

    def expected(self, counts: Array) -> tuple[Array, Array]:
        """Return half-widths and degrees of freedom expected of a number of tests of each kind."""
        covariance = self._covariance(counts)
        variances = np.diag(covariance)
        freedom = np.full(len(variances), np.inf)
        if self.scatters:
            freedom = satterthwaite(self.kinds, counts, covariance, np.eye(len(variances)))
        part = 0.5 + 0.5 * self.level
        unknown = freedom < FEWEST_DEGREES_OF_FREEDOM
        quantiles = np.where(
            np.isinf(freedom),
            ndtri(part),
            stdtrit(np.clip(freedom, FEWEST_DEGREES_OF_FREEDOM, 1e9), part),
        )
        return np.where(unknown, np.inf, quantiles * np.sqrt(variances)), freedom

    def fewest(self) -> Array:
        """Return the number of tests of each kind; CaseError if 1000 are not enough."""
        counts = np.zeros(len(self.kinds), dtype=int)
        for _ in range(MOST):
            counts = min((counts + one for one in np.eye(len(counts), dtype=int)), key=self._size)
            while (better := min(self._exchanged(counts), key=self._size)) is not counts:
                counts = better
            if (longest := np.max(self.expected(counts)[0])) <= self.within:
                return counts
        raise CaseError(
            f"{MOST} tests are not enough for ±{100 * self.within:g} %, but give "
            f"±{100 * longest:.2g} %: ask for less, measure something that depends "
            "more on what is fitted, or leave a parameter out of fit"
        )

    def _covariance(self, counts: Array) -> Array:
        """Return the covariance of the parameters after a number of tests of each kind."""
        once = np.sum(counts[:, None, None] * self.kinds, axis=0)
        return np.linalg.inv(once + RIDGE * np.trace(once) * np.eye(len(once)))

    def _size(self, counts: Array) -> float:
        """Return the sum of squares of the variances, in which the largest counts most."""
        return float(np.sum(np.diag(self._covariance(counts)) ** 2))

    def _exchanged(self, counts: Array) -> list[Array]:
        """Return the counts, then those with one test exchanged for another kind."""
        ones = np.eye(len(counts), dtype=int)
        changed = (counts - ones[i] + add for i in np.flatnonzero(counts) for add in ones)
        return [counts, *changed]
