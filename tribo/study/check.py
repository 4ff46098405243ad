"""The prediction of a case before it runs, as `tribo check` prints it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import asdict, dataclass
from html import escape
from itertools import groupby
from textwrap import wrap
from typing import Any

from tribo.case import Case
from tribo.core.errors import CaseError
from tribo.core.findings import Finding
from tribo.core.material import Material, in_words, materials, typical
from tribo.core.words import readable
from tribo.lab.against_hertz import compared, hertz_half_width, in_mpa
from tribo.model.model import Model
from tribo.motion.reciprocating import Reciprocating
from tribo.simulation.predict import Prediction, predict
from tribo.simulation.run import Simulation
from tribo.simulation.validity import findings_of, unusual


@dataclass(frozen=True)
class Check:
    """The prediction of a case before it runs: printed, it reads as `tribo check` does.

    Parameters
    ----------
    problems : tuple of Finding
        Expected failures and warnings, each with its remedy.
    facts : tuple of Finding
        Findings of packages.
    rows : tuple of (str, str)
        The first contact, the end of a run on a coarse grid, and its memory, in words.
    data : Mapping
        The same as plain data, in SI units; unknown values are None.

    Examples
    --------
    >>> coarse = ["grid.cells=16", "contact.type=winkler", "stop.depth=1 um"]
    >>> check = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse).check()
    >>> [problem.kind for problem in check.problems], check.exit_code  # a run would only warn
    (['resolution'], 0)
    """

    problems: tuple[Finding, ...]
    facts: tuple[Finding, ...]
    rows: tuple[tuple[str, str], ...]
    data: Mapping[str, Any]

    @property
    def exit_code(self) -> int:
        """Exit code of a run; 0 unless a finding must stop it."""
        return int(self.data["exit_code"])

    def text(self, case: str = "The case") -> str:
        """Return it as `tribo check` prints it, in lines of at most 80 characters."""
        verdict = "is valid, but:" if self.problems else "is valid."
        lines = [f"{case} {'would stop on its way:' if self.exit_code else verdict}"]
        lines += _lines(("  -", problem.words) for problem in self.problems)
        lines += _lines((f"  {name}", text) for name, text in self.rows)
        for kind, group in groupby(self.facts, key=lambda finding: finding.kind):
            named = ((f"    {each.place}".rstrip(), each.words) for each in group)
            lines += [f"  {kind}:", *_lines(named)]
        for place, facts in self.data["facts"].items():
            lines += [f"  {place}:", *_lines((f"    {name}", text) for name, text in facts.items())]
        return "\n".join(lines)

    __str__ = __repr__ = text

    def _repr_html_(self) -> str:
        return f"<pre>{escape(self.text())}</pre>"

    def as_json(self) -> dict[str, Any]:
        """Return it as plain data, in SI units."""
        return dict(self.data) | {
            "problems": [each.words for each in self.problems],
            "findings": [asdict(each) for each in (*self.problems, *self.facts)],
        }


def _lines(rows: Iterable[tuple[str, str]]) -> list[str]:
    """Return names with their texts, which begin below each other, in lines."""
    rows = list(rows)
    width = 1 + max((len(name) for name, _ in rows), default=0)
    return [
        line
        for name, text in rows
        for line in wrap(text, 80, initial_indent=f"{name:{width}}", subsequent_indent=" " * width)
    ]


def check_case(case: Case) -> Check:
    """Predict a run of a case, from its first contact and a trial run.

    `CaseError` if the case cannot be run.
    """
    model = Simulation(case).model
    prediction = predict(model)
    found = findings_of(model, prediction.first.half_width_x)
    # What has a limit is beyond it; else a finding is a fact.
    facts = tuple(each for each in found if each.limit is None)
    beyond = (each for each in found if each not in facts)
    problems = dict.fromkeys([*unusual(case), *prediction.problems, *beyond])
    rows = tuple(_facts(model, prediction))
    return Check(tuple(problems), facts, rows, asdict(prediction))


def _facts(model: Model, prediction: Prediction) -> Iterator[tuple[str, str]]:
    """Yield materials, the first contact, the end and the memory of the run, by name."""
    for name, body in model.case.bodies.items():
        yield from _material(name, body.material)
    yield from _first_contact(model, prediction)
    if prediction.positions > 1:
        yield "positions", f"the cycle is resolved at {prediction.positions}"
    elif isinstance(model.case.kinematics, Reciprocating):
        length = 2 * (hertz_half_width(model.contact.system) or prediction.first.half_width_x)
        lengths = f"{model.case.kinematics.stroke / length:.3g} lengths of the first contact"
        micro = readable(1e6 * length, ".3g")
        yield "positions", f"averaged over the stroke, {lengths}, {micro} µm"
    yield from _end(model, prediction)
    yield "memory, about", f"{readable(prediction.memory / 2**20, '.0f')} MiB"


def _material(body: str, material: Material) -> Iterator[tuple[str, str]]:
    """Yield the ranges of the numbers that a body has by the name of its material."""
    with suppress(CaseError):
        name, table = materials.known(material.name or "")
        known = {k: table[k] for k in dict(material) if "range" in table.get(k, ())}
        taken = (k for k, n in known.items() if typical(k, n) == getattr(material, k))
        yield (
            f"material of {body}",
            "; ".join([name, *(f"{k} {in_words(known[k])}" for k in taken)]),
        )


def _first_contact(model: Model, prediction: Prediction) -> Iterator[tuple[str, str]]:
    hertz, first = prediction.hertz, prediction.first
    low, high = model.contact.loads.least, model.contact.loads.largest
    if low < high:
        yield "load", f"{first.load:.4g} N at first, {low:.4g} to {high:.4g} N in all"
    if begin := model.case.begin:
        most = f"p max {in_mpa(first.max_pressure)}"
        yield "first contact", f"of the bodies as worn in {begin}: {most}"
        return
    pressures = first.max_pressure, first.centre_pressure
    yield "first contact", compared(model.contact.system, hertz, *pressures)[1]
    if hertz is not None and prediction.cells_across is not None:
        a, b = 1e6 * hertz.half_width_x, 1e6 * hertz.half_width_y
        line = f"{min(a, b):.4g} µm of a line contact"
        point = f"{a:.4g} × {b:.4g} µm along × across"
        yield "Hertz half-widths", line if hertz.is_line else point
        across = [f"{n:.0f}" for n in prediction.cells_across if math.isfinite(n)]
        yield "cells across the contact", " × ".join(across)


def _end(model: Model, prediction: Prediction) -> Iterator[tuple[str, str]]:
    last = prediction.last
    if last is None:
        yield "final scar", "not estimated"
        return
    widths = (2e3 * last.half_width_x, 2e3 * last.half_width_y)
    size = " × ".join(readable(width, ".2f") for width in widths)
    yield "contact at the end, about", f"{size} mm"
    window = " × ".join(f"{1e3 * edge:.4g}" for edge in model.grid.size)
    yield f"window of {window} mm", "holds it" if prediction.window_holds else "TOO SMALL"
    form = ", but for roughness" if model.rough else ""
    form += ", as averaged" if prediction.positions > 1 else ""
    for name, body in last.bodies.items():
        worn = f"{1e6 * body.max_wear_depth:.3g} µm{form}, {1e9 * body.wear_volume:.3g} mm³"
        yield f"wear of {name}, about", worn
    stop = model.case.stop
    if stop.depth is not None:
        most = max(last.bodies[name].max_wear_depth for name in stop.whose(last.bodies))
        ended = f"not reached, {1e6 * most:.3g} µm at the end"
        if last.time < model.end_time:
            ended = f"reached after {readable(last.time, '.3g')} s"
        yield f"stop.depth of {1e6 * stop.depth:.4g} µm, about", ended
    for passed in prediction.worn_through:
        yield "on a coarse grid, about", str(passed)
    if any(body.layers for body in model.case.bodies.values()) and not prediction.worn_through:
        yield "layers", "none is worn through"
