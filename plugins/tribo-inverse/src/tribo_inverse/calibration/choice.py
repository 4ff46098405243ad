"""Selection between several cases, of different wear laws say, by Schwarz's criterion."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from tribo import Case, CaseError, Finding
from tribo.kernel_api import about, case_tables, validate_case

from tribo_inverse.calibration.calibrate import Calibration, calibrate
from tribo_inverse.calibration.experiment import Experiment
from tribo_inverse.calibration.measured import Measurements, read_measurements
from tribo_inverse.calibration.parameters import is_number
from tribo_inverse.findings import chosen, undecided

STRONG = 6.0
"""Difference of the criterion above which evidence is strong (Kass & Raftery)."""


@dataclass(frozen=True, eq=False)
class Choice:
    """Several cases calibrated to the same data, and their comparison.

    Examples
    --------
    >>> import pandas as pd
    >>> from tribo_inverse import Choice
    >>> cases = pd.DataFrame({"case": ["archard", "power"], "weight": [0.97, 0.03]})
    >>> found = Choice(cases, {}, tribo.Finding("chosen", "the data support archard"))
    >>> found.verdict, found.cases["case"][0]
    ('the data support archard', 'archard')
    """

    cases: pd.DataFrame
    """One row per case, the best first: `case`, its name; `bic`, Schwarz's criterion,
    −2 ln L + p ln n for p parameters and n values; `weight`, its posterior probability with equal
    priors; `parameters`, their number."""
    calibrations: Mapping[str, Calibration]
    """By the name of the case."""
    finding: Finding
    """The case that the data support, or that they are inconclusive."""

    @property
    def verdict(self) -> str:
        """The finding in words."""
        return self.finding.words

    def as_json(self) -> dict[str, Any]:
        """Return it as plain data in SI units; NaN stands for none."""
        own = [self.calibrations[name].as_json() for name in self.cases["case"]]
        cases = self.cases.assign(calibration=own).to_dict("records")
        return {"verdict": self.verdict, "findings": [asdict(self.finding)], "cases": cases}


def choose_case(
    cases: Mapping[str, Case | Mapping[str, Any] | str | Path],
    measured: Measurements | Mapping[str, Any] | str | Path,
    *,
    level: float = 0.95,
    on_run: Callable[[str, int, float], object] = lambda name, run, misfit: None,
) -> Choice:
    """Calibrate several cases to the same data, and compare them by Schwarz's criterion.

    Parameters
    ----------
    cases : Mapping
        Cases, their tables, or their TOML files, by name.
    measured : Measurements, Mapping, str or Path
        As for `calibrate`. Each case fits the parameters that it has.
    level, on_run
        As for `calibrate`; `on_run` gets the name of the case first.

    Returns
    -------
    Choice
        The calibrations, and the case that the data support.

    Raises
    ------
    CaseError, NumericalError
        If there are fewer than two cases, or a case cannot be calibrated.

    References
    ----------
    Schwarz (1978), Ann. Stat. 6, 461-464. Kass and Raftery (1995), J. Am. Stat. Assoc. 90, 773-795.

    Examples
    --------
    >>> from tribo_inverse import choose_case
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "output={}", "kinematics.duration=2"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> cases = {"5 mm": case, "10 mm": case.with_values({"bodies.ball.surface.radius": "10 mm"})}
    >>> mass = {"body": "ball", "quantity": "mass", "value": "0.05 ug", "uncertainty": "5 ng"}
    >>> scar = {"body": "ball", "quantity": "scar_across", "value": "0.3 mm", "uncertainty": "5 um"}
    >>> asked = {"measured": [mass, scar], "fit": [{"path": "bodies.ball.wear.k"}]}
    >>> choose_case(cases, asked).cases["case"][0]  # the radius of the ball, by its scar
    '5 mm'
    """
    if len(cases) < 2:
        raise CaseError("give two cases or more to choose from")
    found, of_each = {}, _measurements_of_each(cases, read_measurements(measured))
    # Errors of each are reported before any is run.
    for name, own in of_each.items():
        with about(name):
            Experiment.of(cases[name], own)
    for name, own in of_each.items():
        with about(name):
            found[name] = calibrate(cases[name], own, level=level, on_run=partial(on_run, name))
    rows = pd.DataFrame(
        {
            "case": name,
            "bic": each.bic,
            "parameters": len(each.parameters),
        }
        for name, each in found.items()
    ).sort_values("bic", ignore_index=True)
    weight = np.exp(-0.5 * (rows["bic"] - rows["bic"].min()))
    rows.insert(2, "weight", weight / weight.sum())
    return Choice(rows, found, _decided(rows, found))


def _measurements_of_each(
    cases: Mapping[str, Case | Mapping[str, Any] | str | Path], measurements: Measurements
) -> dict[str, Measurements]:
    """Return the measurements for each case, with the parameters to fit that it has."""
    known = {name: validate_case(case_tables(case)) for name, case in cases.items()}
    fits = {
        name: tuple(entry for entry in measurements.fit if is_number(case, entry.path))
        for name, case in known.items()
    }
    for i, entry in enumerate(measurements.fit, 1):
        if not any(entry in fit for fit in fits.values()):
            raise CaseError(f"{entry.path} is a number of none of the cases", f"fit.{i}.path")
    for name, fit in fits.items():
        if measurements.fit and not fit:
            raise CaseError(f"{name} has none of the numbers to fit; add one of its own to fit")
    return {name: measurements.model_copy(update={"fit": fit}) for name, fit in fits.items()}


def _decided(rows: pd.DataFrame, found: Mapping[str, Calibration]) -> Finding:
    """Return the finding: the best case, or those that the data do not separate from it."""
    best, *others = rows.itertuples()
    rivals = {each.case: each.bic - best.bic for each in others if each.bic - best.bic < STRONG}
    if not rivals:
        return chosen(best.case, others[0].bic - best.bic, STRONG, found[best.case].p_value)
    return undecided(best.case, rivals, STRONG)
