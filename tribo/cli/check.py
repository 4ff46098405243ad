"""`tribo check`."""

from __future__ import annotations

import json
import math
from dataclasses import asdict
from pathlib import Path
from typing import Any

import click

from tribo.cli.harmless import echo
from tribo.core.errors import CaseError, NumericalError
from tribo.lab.report import yield_words
from tribo.simulation.model import Model
from tribo.simulation.predict import Prediction


@click.command()
@click.argument("case", type=click.Path(path_type=Path))
@click.option("--set", "overrides", multiple=True, metavar="PATH=VALUE", help="Change a value.")
@click.option("--json", "as_json", is_flag=True, help="One JSON object, in SI units.")
def check(case: Path, overrides: tuple[str, ...], as_json: bool) -> None:
    """Validate CASE and predict its first contact, its final scar, and its size.

    What would go wrong comes first. Nothing is written. The scar is estimated on a coarse grid.

    \b
    Example:
      tribo check my.toml

    Exit codes: 0 the run would go to its end, 2 bad input, 3 numerical failure;
    where the run would stop on its way, the code that it would end with.
    """
    from tribo.config.load import load_case
    from tribo.simulation.predict import predict
    from tribo.simulation.run import Simulation

    model = Simulation(load_case(case, overrides=overrides)).model
    prediction = predict(model)
    if as_json:
        click.echo(json.dumps(_finite(asdict(prediction)), indent=2, allow_nan=False))
    else:
        _print(case, model, prediction)
    would_end = f"a run of {case} would stop on its way"
    if prediction.exit_code == CaseError.exit_code:
        raise CaseError(would_end)
    if prediction.exit_code == NumericalError.exit_code:
        raise NumericalError(would_end)


def _print(case: Path, model: Model, prediction: Prediction) -> None:
    echo(f"{case} is valid, but:" if prediction.problems else f"{case} is valid.")
    for problem in prediction.problems:
        echo(f"  - {problem}")
    for name, value in _lines(model, prediction):
        echo(f"  {name:<26}{value}")
    for place, facts in prediction.facts.items():
        echo(f"  {place}:")
        for name, text in facts.items():
            echo(f"    {name:<24}{text}")


def _finite(value: Any) -> Any:
    """Replace what JSON cannot say: the width of a line contact along itself is null."""
    if isinstance(value, dict):
        return {key: _finite(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _lines(model: Model, prediction: Prediction) -> list[tuple[str, str]]:
    lines = []
    hertz = prediction.hertz
    if hertz is None or prediction.cells_across is None:
        lines.append(("first contact", "no Hertz solution for these surfaces"))
    else:
        a, b = hertz.half_width_x, hertz.half_width_y
        if math.isinf(a) or math.isinf(b):
            lines.append(("Hertz half-width", f"{1e6 * min(a, b):.4g} µm of a line contact"))
        else:
            lines.append(("Hertz half-widths", f"{1e6 * a:.4g} × {1e6 * b:.4g} µm along × across"))
        p0 = f"{1e-6 * hertz.peak_pressure:.1f} MPa"
        found = f"computed {1e-6 * prediction.first.max_pressure:.1f} MPa"
        lines.append(("Hertz peak pressure p0", f"{p0}, {found}"))
        if model.system.cap is not None:
            hardness = model.system.cap
            lines.append(("p0/H", f"{hertz.peak_pressure / hardness:.3f}"))
            peak = prediction.first.max_pressure
            lines.append(("yield", yield_words(peak, hardness, line=hertz.is_line)))
        across = [f"{n:.0f}" for n in prediction.cells_across if math.isfinite(n)]
        lines.append(("cells across the contact", " × ".join(across)))
    last = prediction.last
    if last is None:
        lines.append(("final scar", "not estimated"))
    else:
        size = f"{2e3 * last.half_width_x:.2f} × {2e3 * last.half_width_y:.2f} mm"
        lines.append(("contact at the end, about", size))
        window = " × ".join(f"{1e3 * edge:.4g}" for edge in model.grid.size)
        verdict = "holds it" if prediction.window_holds else "TOO SMALL"
        lines.append((f"window of {window} mm", verdict))
        for name, body in last.bodies.items():
            depth = f"{1e6 * body.max_wear_depth:.3g} µm, {1e9 * body.wear_volume:.3g} mm³"
            lines.append((f"wear of {name}, about", depth))
    lines.append(("memory, at most", f"{prediction.memory / 2**20:.0f} MiB"))
    lines.append(("result file, at most", f"{prediction.file_size / 2**20:.1f} MiB"))
    return lines
