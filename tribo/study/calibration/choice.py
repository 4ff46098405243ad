"""Which of several cases, of other laws say, the data speak for; or that they cannot tell."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from tribo.case import Case
from tribo.config.load import case_tables, validate_case
from tribo.core.errors import CaseError, TriboError
from tribo.study.calibration.calibrate import Calibration, calibrate
from tribo.study.calibration.measured import Measurements, read_measurements
from tribo.study.calibration.notes import UNLIKELY
from tribo.study.calibration.parameters import is_number
from tribo.study.calibration.quantities import in_words

STRONG = 6.0
"""Difference of the criterion from which evidence is called strong (Kass & Raftery)."""
_ERRORS = 2.0
SAME = 1e-6
"""Part by which two ratios differ that is rounding."""


@dataclass(frozen=True, eq=False)
class Choice:
    """Several cases calibrated to the same data, and what these say of them."""

    cases: pd.DataFrame
    """A row a case, the best first: `case`, its name; `bic`, Schwarz's criterion, −2 ln L + p ln n
    for p parameters and n values; `weight`, the probability that follows where all were as likely
    before; `left_out`, the log-likelihood of each test foretold from the others, in sum, NaN where
    the others do not determine a parameter; `parameters`, their number."""
    calibrations: Mapping[str, Calibration]
    """By the name of the case."""
    verdict: str
    """What the data say, in a sentence."""

    def as_json(self) -> dict[str, Any]:
        """Return it as plain data in SI units; what is not given is NaN."""
        own = [self.calibrations[name].as_json() for name in self.cases["case"]]
        cases = self.cases.assign(calibration=own).to_dict("records")
        return {"verdict": self.verdict, "cases": cases}


def choose_case(
    cases: Mapping[str, Case | Mapping[str, Any] | str | Path],
    measured: Measurements | Mapping[str, Any] | str | Path,
    *,
    level: float = 0.95,
    on_run: Callable[[str, int, float], object] = lambda name, run, misfit: None,
) -> Choice:
    """Calibrate several cases to the same data, and say for which of them these speak.

    Parameters
    ----------
    cases : Mapping
        By name the cases, their tables, or their TOML files.
    measured : Measurements, Mapping, str or Path
        As for `calibrate`. Of the parameters to fit a case takes those it has.
    level, on_run
        As for `calibrate`; the name of the case is told before the number of its runs.

    Raises
    ------
    CaseError, NumericalError
        If there are fewer than two cases, or one cannot be calibrated.

    References
    ----------
    Schwarz (1978), Ann. Stat. 6, 461-464. Kass and Raftery (1995), J. Am. Stat. Assoc. 90, 773-795.
    Vehtari, Gelman and Gabry (2017), Stat. Comput. 27, 1413-1432.
    """
    if len(cases) < 2:
        raise CaseError("give two cases or more to choose from")
    found = {}
    for name, own in _asked_of_each(cases, read_measurements(measured)).items():
        try:
            found[name] = calibrate(cases[name], own, level=level, on_run=partial(on_run, name))
        except TriboError as error:
            raise type(error)(f"{name}: {error}") from error
    rows = pd.DataFrame(
        {
            "case": name,
            "bic": each.bic,
            "left_out": float(np.sum(each.left_out)) if len(each.left_out) else np.nan,
            "parameters": len(each.parameters),
        }
        for name, each in found.items()
    ).sort_values("bic", ignore_index=True)
    weight = np.exp(-0.5 * (rows["bic"] - rows["bic"].min()))
    rows.insert(2, "weight", weight / weight.sum())
    return Choice(rows, found, _verdict(rows, found))


def _asked_of_each(
    cases: Mapping[str, Case | Mapping[str, Any] | str | Path], asked: Measurements
) -> dict[str, Measurements]:
    """Return what is asked of each case, which is to fit those of the parameters that it has."""
    known = {name: validate_case(case_tables(case)) for name, case in cases.items()}
    fits = {
        name: tuple(entry for entry in asked.fit if is_number(case, entry.path))
        for name, case in known.items()
    }
    for i, entry in enumerate(asked.fit):
        if not any(entry in fit for fit in fits.values()):
            raise CaseError(f"{entry.path} is a number of none of the cases", f"fit.{i}.path")
    for name, fit in fits.items():
        if asked.fit and not fit:
            raise CaseError(f"{name} has none of the numbers to fit; add one of its own to fit")
    return {name: asked.model_copy(update={"fit": fit}) for name, fit in fits.items()}


def _verdict(rows: pd.DataFrame, found: Mapping[str, Calibration]) -> str:
    best, *others = rows.itertuples()
    doubts = []
    for other in others:
        by = other.bic - best.bic
        ahead = found[best.case].left_out - found[other.case].left_out
        error = float(np.std(ahead, ddof=1) * len(ahead) ** 0.5) if len(ahead) > 1 else np.inf
        # Where a test alone determines a parameter it cannot be left out.
        refuted = bool(np.sum(ahead) < -_ERRORS * error)
        if by < STRONG or refuted:
            doubts.append((other.case, by))
    if not doubts:
        by = others[0].bic - best.bic
        told = f"the data speak for {best.case}: Schwarz's criterion is lower by {by:.3g} or more"
        wrong = found[best.case].p_value
        if wrong is not None and wrong < UNLIKELY:
            told += f"; yet {best.case} does not describe them either (p = {wrong:.1g})"
        return told
    names = " and ".join([best.case, *(name for name, _ in doubts)])
    differs = ", ".join(f"{by:.2g}" for _, by in doubts)
    told = f"these data cannot tell {names} apart: Schwarz's criterion differs by {differs}"
    return f"{told}, where {STRONG:g} is strong evidence{_telling(found, best.case, doubts[0][0])}"


def _telling(found: Mapping[str, Calibration], first: str, second: str) -> str:
    """Name the quantity in which two cases differ most, for the next test."""
    keys = ["test", "body", "quantity"]
    both = found[first].predictions.merge(found[second].predictions, on=keys)
    both["ratio"] = both["value_x"] / both["value_y"]
    data = found[first].data
    ratios = data.assign(ratio=data["computed"] / found[second].data["computed"])

    def is_new(row: Any) -> bool:
        # What differs as a measured number of the body does is that number, as a volume is a mass.
        own = ratios[(ratios["test"] == row.test) & (ratios["body"] == row.body)]
        return not np.any(np.abs(own["ratio"] / row.ratio - 1) < SAME)

    both = both[[is_new(row) for row in both.itertuples()]]
    if not len(both):
        return ""
    each = both.loc[np.abs(np.log(both["ratio"])).idxmax()]
    where = f" in {each.test}" if each.test else ""
    values = [in_words(each.quantity, value) for value in (each.value_x, each.value_y)]
    return (
        f"; of what was not measured they differ most in the {each.quantity} of {each.body!r}"
        f"{where}: {values[0]} and {values[1]}"
    )
