"""A run that a depth ends: how long it is follows every input."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from tribo import CaseError, State
from tribo.kernel_api import DEPTH_ACCURACY, Model

from tribo_inverse.adjoint.backwards import JUST, Derivatives, swept_back
from tribo_inverse.adjoint.objective import Seeds
from tribo_inverse.adjoint.parameters import Chain, of_length
from tribo_inverse.recording.tape import Tape


def at_depth(
    model: Model, tape: Tape, seeds: Mapping[float, Seeds], chains: Sequence[Chain], end: State
) -> tuple[Derivatives, float]:
    """Return the derivatives of a run that ends at a depth, and that in this depth, in 1/m.

    With J the objective, and D the depth at the time t, a number p that the depth follows changes t
    by −(∂D/∂p)/(∂D/∂t), and so J by ∂J/∂p − (∂J/∂t)/(∂D/∂t) ∂D/∂p, both at a fixed time.

    Raises
    ------
    CaseError
        If the depth went past its limit in a jump.
    """
    length, last = of_length(model, end.time), model.end_time
    at_end = {**dict.fromkeys(seeds, Seeds()), last: _deepest(model, end)}
    objective, depth = (
        swept_back(model, tape, each, [length, *chains]) for each in (seeds, at_end)
    )
    by_time = objective.parameters[0] + length.by_save(end.time, seeds[last])
    by_depth = by_time / depth.parameters[0]
    found = objective.plus(-by_depth, depth)
    return replace(found, parameters=found.parameters[1:]), by_depth


def _deepest(model: Model, end: State) -> Seeds:
    """Return 1 at the cell whose depth ended the run, the first of those that are as deep."""
    stop = model.case.stop
    assert stop.depth is not None
    worn = {name: end.bodies[name].wear for name in stop.whose(end.bodies)}
    name = max(worn, key=lambda each: float(np.max(worn[each])))
    depth, most = worn[name], float(np.max(worn[name]))
    if most > stop.depth * (1 + DEPTH_ACCURACY):
        raise CaseError(
            f"the depth jumps from below {1e6 * stop.depth:g} µm to {1e6 * most:g} µm however "
            "short the last step, so that the end of the run has no derivative; take shorter "
            "steps, or another depth",
            "stop.depth",
        )
    seed = np.zeros_like(depth)
    seed.flat[np.argmax(depth >= most * (1 - JUST))] = 1.0
    return Seeds({name: seed})
