"""The history of a run with rests, to be drawn as lines from row to row."""

from __future__ import annotations

import numpy as np

from tribo.core.arrays import Array
from tribo.result.read import Result


def with_rests(result: Result) -> dict[str, Array]:
    """Return the history with one more row where each step of a rest begins, and where it ends.

    A row has the load and the friction force of the step before it. A line from row to row would
    change all along a rest, a long step, while the load jumps at its beginning unless it changes
    linearly.
    """
    history = result.table("history")
    stages = (result.case_tables.get("load") or {}).get("normal")
    straight = isinstance(stages, list | tuple) and any(stage.get("at") for stage in stages)
    resting = np.diff(history["distance_m"]) == 0
    starts = np.flatnonzero(resting | np.append(False, resting)[:-1])
    rows = {"time_s": starts, "friction_force_N": starts + 1}
    later = starts + (resting[starts] & (not straight))
    return {
        name: np.insert(column, starts + 1, column[rows.get(name, later)])
        for name, column in history.items()
    }
