"""A validation case: a folder with a case, or a script, and what it must give."""

from __future__ import annotations

import runpy
import warnings
from collections.abc import Iterator, Mapping
from contextlib import chdir
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Literal

import numpy as np
from pydantic import ValidationError

from tribo.component import components
from tribo.config.load import case_tables, read_toml, validate_case
from tribo.config.overrides import apply_settings
from tribo.core.arrays import Array
from tribo.core.errors import CaseError, TriboError, located
from tribo.core.explain import case_error
from tribo.core.table import given
from tribo.core.words import said
from tribo.registry.registry import default_registry
from tribo.result.quantity import quantity
from tribo.result.read import Result
from tribo.simulation.run import Simulation
from tribo.verification.expected import Expectation, Expected

Verdict = Literal["holds", "fails", "not installed"]
Found = tuple[Array, str]
"""Values of a quantity at its places, and their SI unit."""

ORDER_MARGIN = 0.2
"""Of an observed order from the stated one, which it approaches only on fine grids."""


@dataclass(frozen=True)
class Row:
    """The expected and the computed value of a quantity in a case, and whether they agree."""

    case: str
    title: str
    quantity: str
    source: str
    kind: str
    published: bool
    tolerance: float
    reason: str
    solver: str = ""
    """The contact solver, if the case names another one."""
    unit: str = "1"
    expected: float | None = None
    """At the first place, at the finest level."""
    got: float | None = None
    error: float | None = None
    theory: float | None = None
    order: float | None = None
    """Observed order of convergence; `theory` is the expected one."""
    verdict: Verdict = "fails"

    def __str__(self) -> str:
        if self.got is None:
            return f"{self.case}: {self.reason}"
        given = f"expected {self.expected:.7g} {self.unit}, got {self.got:.7g}"
        error = f"error {self.error:.2g} of at most {self.tolerance:g}"
        if self.theory is not None:
            error += f", order {self.order or 0:.2f} of {self.theory:g}"
        return f"{self.case}: {self.quantity}: {given}, {error} ({self.source})"


@dataclass(frozen=True)
class ValidationCase:
    """A folder with `expected.toml`, and `case.toml` or a script that is called as the folder.

    A script has a `CASE`, or a function `found` from the settings of a level to the quantities. A
    case beside a `first.toml` begins with the worn bodies of that case.
    """

    folder: Path

    @property
    def name(self) -> str:
        """What the case is called: the name of its folder."""
        return self.folder.name

    @cached_property
    def expected(self) -> Expected:
        """What it must give; CaseError, a line for each error, if the file is wrong."""
        path = self.folder / "expected.toml"
        try:
            tables = read_toml(path, "expected values", "see the page 'Verification'")
            return Expected.model_validate(tables)
        except ValidationError as error:
            raise CaseError(f"{path}: {case_error(error)}") from None

    @cached_property
    def _script(self) -> dict[str, Any]:
        path = self.folder / f"{self.name}.py"
        return runpy.run_path(str(path)) if path.exists() else {}

    def tables(self) -> Mapping[str, Any] | None:
        """Return the tables of its case; None of a script that has none."""
        if self._script:
            case = self._script.get("CASE")
            return None if case is None else case_tables(case)
        return read_toml(self.folder / "case.toml")

    @property
    def uses(self) -> set[str]:
        """Types of its components and other solvers, and the keys that it sets, as ``type.key``."""
        tables, found = self.tables(), set(self.expected.solvers)
        if tables is None:
            return found
        with chdir(self.folder):
            case = validate_case(tables)
        for part in [*(part for _, part in components(case)), *case.kinematics.effects()]:
            found |= {part.type, *(f"{part.type}.{key}" for key in given(part))}
        return found

    def run(self) -> Iterator[Row]:
        """Compute and judge every quantity, with the case's solver and the others."""
        yield from self._rows({}, "")
        for solver in self.expected.solvers:
            if default_registry().find(solver) is None:
                yield self._row(self.expected.expect[0], solver, verdict="not installed")
            else:
                yield from self._rows({"contact.type": solver}, solver)

    def _rows(self, settings: Mapping[str, Any], solver: str) -> list[Row]:
        wanted, lists = self.expected.expect, self.expected.levels
        try:
            each = [dict(zip(lists, row, strict=True)) for row in zip(*lists.values(), strict=True)]
            with warnings.catch_warnings(), chdir(self.folder):
                warnings.simplefilter("ignore")
                levels = [self._found({**settings, **at}) for at in each or [{}]]
            return [
                self._judged(row, solver, values)
                for row, *values in zip(wanted, *levels, strict=True)
            ]
        except Exception as error:
            words = str(error) if isinstance(error, TriboError) else said(error)
            return [self._row(wanted[0], solver, reason=words)]

    def _found(self, settings: Mapping[str, Any]) -> list[Found]:
        """Return the value of every quantity in one run."""
        wanted, tables = self.expected.expect, self.tables()
        if tables is None:
            found = self._script["found"](**settings)
            return [(np.array([found[row.quantity]]), "1") for row in wanted]
        with TemporaryDirectory() as place:
            if Path("first.toml").exists():
                first = Path(place, "first.h5")
                Simulation(validate_case(read_toml(Path("first.toml")))).run(first).close()
                tables = {**tables, "begin": str(first)}
            with Simulation(validate_case(apply_settings(tables, settings))).run() as result:
                return [_read(result, row, i) for i, row in enumerate(wanted, start=1)]

    def _judged(self, row: Expectation, solver: str, levels: list[Found]) -> Row:
        got, unit = levels[-1]
        value = row.numbers(unit)
        size = float(np.sum(np.abs(value))) or 1.0
        errors = [float(np.sum(np.abs(at - value)) / size) for at, _ in levels]
        order, holds = None, errors[-1] <= row.tolerance
        if row.order is not None:
            order = self._order(errors)
            holds = holds and order is not None and abs(order - row.order) <= ORDER_MARGIN
        return self._row(
            row,
            solver,
            unit=unit,
            expected=float(value[0]),
            got=float(got[0]),
            error=errors[-1],
            theory=row.order,
            order=order,
            verdict="holds" if holds else "fails",
        )

    def _order(self, errors: list[float]) -> float | None:
        """Return the order at which errors fall over the levels, which are numbers."""
        values = next(iter(self.expected.levels.values()), ())
        sizes = [value[0] if isinstance(value, list) else value for value in values]
        if len(sizes) < 3 or not 0 < errors[-1] < errors[0]:
            return None
        return abs(float(np.polyfit(np.log(sizes), np.log(errors), 1)[0]))

    def _row(self, row: Expectation, solver: str, **judged: Any) -> Row:
        wanted = self.expected
        return Row(
            case=self.name,
            title=wanted.title,
            quantity=row.label,
            source=row.source or wanted.source,
            kind=row.kind or wanted.kind,
            published=wanted.published if row.published is None else row.published,
            tolerance=row.tolerance,
            solver=solver,
            **{"reason": row.reason, **judged},
        )


def _read(result: Result, row: Expectation, number: int) -> Found:
    with located(f"expect.{number}"):
        values, unit = quantity(result, row.quantity, row.body, row.time, row.place)
        row.numbers(unit)
    return values, unit
