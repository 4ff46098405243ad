"""A few seconds' check of this installation: a short run against closed forms, and itself."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass

import numpy as np

from tribo.config.load import validate_case
from tribo.config.overrides import apply_settings
from tribo.core.errors import TriboError
from tribo.lab.first_contact import hertz_contact
from tribo.simulation.run import Simulation
from tribo.templates import template

_SHORT = ("grid={ size = 0.7e-3, cells = 64 }", "kinematics.duration=20", "output.save_times=[]")
"""What differs from the paper's hour."""


@dataclass(frozen=True)
class SelfTest:
    """One check: its name, whether it passed, and what was found."""

    name: str
    ok: bool
    detail: str


def self_test() -> list[SelfTest]:
    """Run a short case and compare it with closed forms, and with itself."""
    try:
        case = validate_case(apply_settings(tomllib.loads(template("ball_on_disk")), _SHORT))
        first, second = Simulation(case).run(), Simulation(case).run()
    except TriboError as error:
        return [SelfTest("a short run", False, str(error))]
    hertz = hertz_contact(first.system)
    assert hertz is not None
    start, end = first.saves()[0], first.saves()[-1]
    off = start["max_pressure_Pa"] / hertz.peak_pressure - 1
    volume = end["bodies"]["ball"]["wear_volume_m3"]
    balance = abs(volume / (3.11e-16 * 100 * end["distance_m"]) - 1)
    same = bool(np.array_equal(first.field("pressure", -1), second.field("pressure", -1)))
    return [
        # On 64 cells the peak lies between cells: 0.1 % is its discretisation.
        SelfTest("Hertz peak pressure", abs(off) < 5e-3, f"{100 * off:+.3f} %"),
        SelfTest("worn volume = k F s", balance < 1e-10, f"off by {balance:.0e}"),
        SelfTest("same case, same bits", same, "equal" if same else "different"),
    ]
