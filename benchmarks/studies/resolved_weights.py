"""The paper's weights fitted with its stroke resolved, without and with the crown of its ball.

The page on calibration shows the figures. They come from a run of some minutes:

    python -m benchmarks.studies.resolved_weights --json docs/_data/resolved_weights.json
"""

from __future__ import annotations

import argparse
import warnings
from importlib.resources import files
from typing import Any

from tribo_inverse import calibrate

from benchmarks.lib.common import Row, Tables, main
from tribo import TriboWarning
from tribo.config.load import read_toml
from tribo.config.overrides import apply_settings

CROWN = {"body": "ball", "quantity": "crown", "value": "10 um", "uncertainty": "1 um"}
"""Read off the paper's profile of the worn ball."""


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the grid and the positions of the stroke."""
    parser.add_argument("--cells", type=int, default=48)
    parser.add_argument("--positions", default="33", help="of the stroke, or average")


def measure(options: argparse.Namespace) -> Tables:
    """Return estimates and what follows, with their intervals, and how good each fit is."""
    warnings.simplefilter("ignore", TriboWarning)
    settings = [f"grid.cells={options.cells}", f"kinematics.positions={options.positions}"]
    templates = files("tribo.templates")
    case = apply_settings(read_toml(templates / "weighed_split.toml"), settings)
    weighed = read_toml(files("tribo_inverse") / "templates/weighed.toml")
    intervals, fits = [], []
    for data, more in (("weights alone", []), ("with a crown of 10 ± 1 µm", [CROWN])):
        found = calibrate(case, weighed | {"measured": weighed["measured"] + more})
        intervals += [
            {"data": data, **ends(f"{each.path}, 1e-16 1/Pa", each, 1e16)}
            for each in found.parameters.itertuples()
        ]
        intervals += [
            {"data": data, **ends(f"{each.body}, {each.quantity}, µm", each, 1e6)}
            for each in found.predictions.itertuples()
            if each.quantity in ("depth", "crown")
        ]
        crown = found.data.loc[found.data["quantity"] == "crown", "computed"]
        fit = {"chi_square": found.chi_square, "p_value": found.p_value}
        fits.append({"data": data, **fit, "crown_um": 1e6 * crown.iloc[0] if more else None})
    return {"intervals": intervals, "fits": fits}


def ends(name: str, row: Any, factor: float) -> Row:
    """Return a value and the ends of its interval, in the unit that the name says."""
    return {
        "what": name,
        "value": factor * row.value,
        "lower": factor * row.lower,
        "upper": factor * row.upper,
    }


if __name__ == "__main__":
    main(__doc__, add_options, measure)
