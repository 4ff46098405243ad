"""`tribo check`."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict
from itertools import groupby
from pathlib import Path

import click
from rich.table import Table
from rich.text import Text

from tribo.cli.console import Console
from tribo.cli.options import CASE, JSON, PLUGIN, SET, echo_json
from tribo.cli.waiting import waiting_for
from tribo.core.errors import CaseError, NumericalError
from tribo.core.findings import Finding
from tribo.core.words import readable
from tribo.lab.against_hertz import (
    HertzContact,
    computed_pressure,
    hertz_half_width,
    in_mpa,
    yield_words,
)
from tribo.model.model import Model
from tribo.motion.reciprocating import Reciprocating
from tribo.simulation.positions import lengths_of
from tribo.simulation.predict import Prediction

SPREAD = 3.0
"""Factor to which the time of a run is known."""


@click.command()
@CASE
@SET
@PLUGIN
@JSON
def check(case: Path, overrides: tuple[str, ...], as_json: bool) -> None:
    """Validate CASE and predict its first contact, its final scar, and its size.

    What would go wrong comes first. Nothing is written. The scar is estimated on a coarse grid.

    \b
    Example:
      tribo check my.toml

    Exit codes: 0 nothing found on which the run must stop, 2 bad input, 3
    numerical failure; where it must stop, the code that it would end with.
    """
    from tribo.config.load import load_case
    from tribo.guards.trial_time import TRIAL_TIME
    from tribo.simulation.doubt import unusual
    from tribo.simulation.predict import predict
    from tribo.simulation.run import Simulation
    from tribo.simulation.validity import findings_of

    read = load_case(case, overrides=overrides)
    with waiting_for("composing the case"):
        model = Simulation(read).model
    with waiting_for(f"first contact and a trial run of {TRIAL_TIME:g} s at most"):
        prediction = predict(model)
    with waiting_for(f"what packages have to say, {TRIAL_TIME:g} s at most"):
        found = findings_of(model, prediction.first.half_width_x)
    # What has a limit is beyond it; else a finding is a fact.
    facts = [each for each in found if each.limit is None]
    beyond = [each for each in found if each not in facts]
    problems = list(dict.fromkeys([*unusual(read), *prediction.problems, *beyond]))
    if as_json:
        averaging = (each.words for each in problems if each.kind == "averaging")
        echo_json(
            asdict(prediction)
            | {
                "limitation": next(averaging, None),
                "problems": [each.words for each in problems],
                "findings": [asdict(each) for each in (*problems, *facts)],
            }
        )
    else:
        _print(case, model, prediction, problems, facts)
    for kind in (CaseError, NumericalError):
        if prediction.exit_code == kind.exit_code:
            raise kind(f"a run of {case} would stop on its way: {prediction.stops}")


def _print(
    case: Path,
    model: Model,
    prediction: Prediction,
    problems: Sequence[Finding],
    found: Sequence[Finding],
) -> None:
    console = Console()
    verdict = "is valid, but:" if problems else "is valid."
    if prediction.exit_code:
        verdict = "would stop on its way:"
    console.print(f"{case} {verdict}", markup=False, soft_wrap=True)
    console.print(_rows(("  -", problem.words) for problem in problems))
    console.print(_rows((f"  {name}", text) for name, text in _facts(model, prediction)))
    for kind, group in groupby(found, key=lambda finding: finding.kind):
        console.print(f"  {kind}:", markup=False)
        console.print(_rows((f"    {each.place}".rstrip(), each.words) for each in group))
    for place, facts in prediction.facts.items():
        console.print(f"  {place}:", markup=False)
        console.print(_rows((f"    {name}", text) for name, text in facts.items()))


def _rows(rows: Iterable[tuple[str, str]]) -> Table:
    """Return names and texts in two columns, wrapped to the width."""
    table = Table.grid(padding=(0, 1))
    for row in rows:
        table.add_row(*map(Text, row))
    return table


def _widths(hertz: HertzContact) -> str:
    a, b = 1e6 * hertz.half_width_x, 1e6 * hertz.half_width_y
    if hertz.is_line:
        return f"{min(a, b):.4g} µm of a line contact"
    return f"{a:.4g} × {b:.4g} µm along × across"


def _facts(model: Model, prediction: Prediction) -> Iterator[tuple[str, str]]:
    """Yield the first contact, the end and the size of the run, each with its name."""
    yield from _first_contact(model, prediction)
    if model.chosen is not None or prediction.positions > 1:
        resolved = f"the cycle is resolved at {prediction.positions}"
        yield "positions", model.chosen.words if model.chosen else resolved
        if prediction.positions_for_1_percent is not None:
            words = f"{prediction.positions_for_1_percent} if the contact stays as it is at first"
            yield "positions for 1 % of the depth, about", words
    elif isinstance(model.case.kinematics, Reciprocating):
        half_width = hertz_half_width(model.contact.system) or prediction.first.half_width_x
        lengths = lengths_of(model.case.kinematics.stroke, half_width)
        yield "positions", f"averaged over the stroke, {lengths}"
    yield from _end(model, prediction)
    if prediction.run_time is not None:
        soonest, latest = prediction.run_time / SPREAD, prediction.run_time * SPREAD
        yield "run time here, about", f"{readable(soonest, '.2g')} to {readable(latest, '.2g')} s"
    yield "memory, at most", f"{readable(prediction.memory / 2**20, '.0f')} MiB"
    yield "result file, at most", f"{readable(prediction.file_size / 2**20, '.1f')} MiB"


def _first_contact(model: Model, prediction: Prediction) -> Iterator[tuple[str, str]]:
    hertz, first = prediction.hertz, prediction.first
    low, high = model.contact.loads.least, model.contact.loads.largest
    if low < high:
        yield "load", f"{first.load:.4g} N at first, {low:.4g} to {high:.4g} N in all"
    if begin := model.case.begin:
        most = f"p max {in_mpa(first.max_pressure)}"
        yield "first contact", f"of the bodies as worn in {begin.result}: {most}"
    elif prediction.hertz_bounds:
        below, above = prediction.hertz_bounds
        said = "{} without the layer, {} of the layer throughout"
        yield "Hertz half-widths", said.format(_widths(below), _widths(above))
        peaks = (in_mpa(each.peak_pressure) for each in (below, above))
        _, computed = computed_pressure(
            model.contact.system, first.max_pressure, first.centre_pressure
        )
        yield "Hertz peak pressure p0", f"{said.format(*peaks)}, computed {computed}"
    elif hertz is None or prediction.cells_across is None:
        yield "first contact", "no Hertz solution for these surfaces"
    else:
        p0 = hertz.peak_pressure
        yield "Hertz half-widths", _widths(hertz)
        pressure, computed = computed_pressure(
            model.contact.system, first.max_pressure, first.centre_pressure
        )
        yield "Hertz peak pressure p0", f"{in_mpa(p0)}, computed {computed}"
        hardness = model.contact.system.cap
        if hardness is not None:
            yield "p0/H", f"{p0 / hardness:.3f}"
            yield "yield", yield_words(pressure, hardness, hertz)
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
        path, end = (readable(passed[key], ".3g") for key in ("distance_m", "time_s"))
        when = f"{path} m, {end} s"
        yield f"layer {passed['layer']} of {passed['body']} worn through, about", when
    if any(body.layers for body in model.case.bodies.values()) and not prediction.worn_through:
        yield "layers", "none is worn through"
