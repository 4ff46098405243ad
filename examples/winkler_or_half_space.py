"""When is a Winkler foundation good enough? The paper's test on springs and on half-spaces.

Runs the template `ball_on_disk` on elastic half-spaces and on springs matched to
Hertz's first contact in each of the three ways, and prints how far the springs
are off as the bodies wear. Then the same with a lighter load, a softer steel
and a ball that wears ten times less. Takes about ten seconds::

    python examples/winkler_or_half_space.py
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import tribo.templates
from tribo import Comparison, TriboWarning, compare
from tribo.lab.against_hertz import hertz_contact

CASE = Path(tribo.templates.__file__).with_name("ball_on_disk.toml")
HALF_SPACE = "half-space"
MATCHES = ("contact_radius", "peak_pressure", "approach")
SAVES = (0, 10, 30, 100, 200, 500, 1500, 3600)
COARSE = {"grid.cells": 64, "grid.size": "1.4 mm"}
CASES: Mapping[str, Mapping[str, Any]] = {
    "the paper's test": {},
    "20 N": {"load.normal": "20 N", "grid.size": "0.9 mm"},
    "70 GPa": {"bodies.ball.material.young": "70 GPa", "bodies.disk.material.young": "70 GPa"},
    "ball wears a tenth": {"bodies.ball.wear.k": "3.11e-17 1/Pa"},
}


@dataclass(frozen=True)
class Error:
    """How far springs are off at a save, relative to the half-space.

    Parameters
    ----------
    match : str
        What the springs were matched to.
    time : float
        In s.
    worn : float
        Depth worn off both bodies over the approach of Hertz's first contact.
    pressure, width, depth : float
        Errors of the largest pressure, of the square root of the contact area,
        and of the depth of the body of which it is further off.
    """

    match: str
    time: float
    worn: float
    pressure: float
    width: float
    depth: float


def run(settings: Mapping[str, Any] | None = None) -> Comparison:
    """Run a case on half-spaces and on springs matched in three ways.

    Parameters
    ----------
    settings : Mapping, optional
        Changes to the paper's case: values by path.
    """
    common = {**COARSE, "output.save_times": list(SAVES), **(settings or {})}
    contacts = [{"type": "dcfft"}, *({"type": "winkler", "match": match} for match in MATCHES)]
    return compare(
        CASE,
        [{**common, "contact": contact} for contact in contacts],
        labels=[HALF_SPACE, *MATCHES],
    )


def errors(comparison: Comparison) -> list[Error]:
    """Return how far the springs are off at each save."""
    hertz = hertz_contact(comparison.results[HALF_SPACE].system)
    assert hertz is not None
    assert hertz.approach is not None
    found = []
    for time in comparison.times:
        right = comparison.save(HALF_SPACE, time)
        worn = sum(body["max_wear_depth_m"] for body in right["bodies"].values())
        for match in MATCHES:
            save = comparison.save(match, time)
            depths = [
                save["bodies"][name]["centre_wear_depth_m"] / body["centre_wear_depth_m"] - 1
                for name, body in right["bodies"].items()
                if body["centre_wear_depth_m"] > 0
            ]
            found.append(
                Error(
                    match=match,
                    time=time,
                    worn=worn / hertz.approach,
                    pressure=save["max_pressure_Pa"] / right["max_pressure_Pa"] - 1,
                    width=(save["contact_area_m2"] / right["contact_area_m2"]) ** 0.5 - 1,
                    depth=max(depths, key=abs, default=0.0),
                )
            )
    return found


def table(found: list[Error]) -> str:
    """Return errors in percent as text, a row a save."""
    heads = "".join(f"  {match:>22}" for match in MATCHES)
    lines = [f"{'':>6}  {'worn/':>8}{heads}"]
    lines += [f"{'time':>6}  {'approach':>8}" + "  pressure  width  depth" * len(MATCHES)]
    for time in dict.fromkeys(error.time for error in found):
        row = [error for error in found if error.time == time]
        cells = "".join(
            f"  {100 * e.pressure:+8.1f}{100 * e.width:+7.1f}{100 * e.depth:+7.1f}" for e in row
        )
        lines.append(f"{time:6.0f}  {row[0].worn:8.2f}{cells}")
    return "\n".join(lines)


def main() -> None:
    """Run all cases and print the errors."""
    # That coarse grids resolve a light first contact badly matters to none of the ratios.
    warnings.simplefilter("ignore", TriboWarning)
    for name, settings in CASES.items():
        with run(settings) as comparison:
            print(f"{name}, errors in %\n{table(errors(comparison))}\n")


if __name__ == "__main__":
    main()
