"""The paper's one-hour test, simulated, and compared with what is known of it.

Runs the template `ball_on_disk` as it stands, on a coarser grid with both steppings
(the paper's is explicit, 0.25 s a step) and on a Winkler foundation, and
prints the results beside each other. Takes about a minute::

    python examples/paper.py
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

import tribo.templates
from tribo import Result, Simulation, load_case

TEMPLATES = Path(tribo.templates.__file__).parent
CASE = TEMPLATES / "ball_on_disk.toml"
SPLIT = TEMPLATES / "weighed_split.toml"

COARSE = ("grid.cells=64", "grid.size='1.3 mm'")
IMPLICIT = ("stepping.type=implicit",)
EXPLICIT = ("stepping.type=explicit", "stepping.time_step='0.25 s'")
WINKLER = ("contact.type=winkler",)

EXPECTED: Mapping[str, Sequence[float]] = {
    "time, s": (0, 200, 500, 1500, 3600),
    "half-width along, µm": (148.8, 254, 315, 406, 496),
    "half-width across, µm": (148.8, 274, 342, 455, 569),
    "centre pressure, MPa": (2155, 495, 300, 167, 106),
    "largest pressure, MPa": (2155, 495, 330, 207, 143),
    "ball depth, µm": (0, 5.660, 9.142, 15.84, 24.31),
    "disk depth, µm": (0, 0.955, 1.896, 4.252, 8.040),
}
"""From an elastic computation made apart from tribo: backward Euler with increments of
0.25 m or less, 128² to 192² cells on 1.3 mm. Good to a cell in the half-widths, 4 % in the
largest and 1 % in the centre pressure, 0.3 % in the depths."""


def run(*overrides: str, case: Path = CASE) -> Result:
    """Run a case, changed as by ``tribo run --set``, in memory.

    Parameters
    ----------
    *overrides : str
        Changes, as ``"grid.cells=64"``.
    case : Path, optional
        The case; the paper's if left out.
    """
    return Simulation(load_case(case, overrides=overrides)).run()


def table(result: Result) -> dict[str, list[float]]:
    """Return a result in the rows of `EXPECTED`."""
    saves = result.saves()
    ball, disk = result.body_names
    return {
        "time, s": [s["time_s"] for s in saves],
        "half-width along, µm": [1e6 * s["contact_half_width_x_m"] for s in saves],
        "half-width across, µm": [1e6 * s["contact_half_width_y_m"] for s in saves],
        "centre pressure, MPa": [1e-6 * s["centre_pressure_Pa"] for s in saves],
        "largest pressure, MPa": [1e-6 * s["max_pressure_Pa"] for s in saves],
        "ball depth, µm": [1e6 * s["bodies"][ball]["centre_wear_depth_m"] for s in saves],
        "disk depth, µm": [1e6 * s["bodies"][disk]["centre_wear_depth_m"] for s in saves],
    }


def side_by_side(tables: Mapping[str, Mapping[str, Sequence[float]]]) -> str:
    """Return tables as text, each quantity's rows below one another."""
    names = list(tables)
    first = tables[names[0]]
    width = max(map(len, names)) + 4
    lines = ["time, s".ljust(width) + _cells(first["time, s"], "{:.0f}")]
    for quantity in list(first)[1:]:
        digits = "{:.3f}" if "depth" in quantity else "{:.0f}"
        lines += ["", quantity]
        lines += [
            f"  {name}".ljust(width) + _cells(tables[name][quantity], digits) for name in names
        ]
    return "\n".join(lines)


def difference(one: Result, other: Result, body: str) -> float:
    """Return the largest relative difference of a body's depth at the saves after the first."""
    column = f"bodies.{body}.centre_wear_depth_m"
    a, b = one.table("saves")[column][1:], other.table("saves")[column][1:]
    return float(np.max(np.abs(a / b - 1)))


def main() -> None:
    """Run the four simulations and print them beside the expected values."""
    as_it_stands = run()
    implicit, explicit = run(*COARSE, *IMPLICIT), run(*COARSE, *EXPLICIT)
    winkler = run(*WINKLER)
    print(
        side_by_side(
            {
                "expected": EXPECTED,
                "256², implicit": table(as_it_stands),
                "64², implicit": table(implicit),
                "64², explicit, 0.25 s": table(explicit),
                "256², Winkler": table(winkler),
            }
        )
    )
    print("\nImplicit against explicit, largest difference in depth")
    for body in implicit.body_names:
        print(f"  {body:<6}{100 * difference(implicit, explicit, body):.2f} %")
    print("\nSteps and wall time")
    for name, result in (("implicit", implicit), ("explicit", explicit)):
        totals = result.totals()
        print(f"  {name:<10}{totals['steps']:>6} steps {totals['wall_time_s']:>6.1f} s")


def _cells(values: Sequence[float], digits: str) -> str:
    return "".join(digits.format(value).rjust(9) for value in values)


if __name__ == "__main__":
    main()
