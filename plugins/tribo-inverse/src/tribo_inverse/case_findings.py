"""What is to be known of a case, in words and numbers: which of its numbers rule the answer."""

from __future__ import annotations

from tribo import CaseError, Finding, NumericalError
from tribo.kernel_api import Model, leaves

from tribo_inverse.adjoint.sensitivity import sensitivity

MOST = 8
"""Numbers of a case that are reported."""


def of_case(model: Model, half_width_x: float) -> list[Finding]:
    """Return the `MOST` numbers that rule a case, with half its first contact's length, in m."""
    try:
        found = sensitivity(model, half_width_x)
    except (CaseError, NumericalError) as error:
        return [Finding("sensitivity", f"not known, since {error}")]
    depth, time = f"depth of {found.body}", f"time until {found.body} reaches stop.depth"
    what = depth if found.of == "depth" else time
    kelvin = {
        ".".join(map(str, place)): value
        for place, value, mark in leaves(model.case)
        if mark and mark.unit == "K"
    }
    return [
        _sensitivity(what, path, change, found.uncertainty[path], kelvin.get(path))
        for path, change in [*found.percent.items()][:MOST]
    ]


def _sensitivity(
    what: str, path: str, change: float, uncertainty: float, kelvin: float | None
) -> Finding:
    """Word by how many per cent an answer changes for 1 % more of a number, or 1 K more."""
    # A per cent of a temperature is one of its distance from absolute zero.
    more, per = ("1 %", 1.0) if kelvin is None else ("1 K", 100 / kelvin)
    return Finding(
        "sensitivity",
        f"{what} {per * change:+.2f} ± {per * uncertainty:.2f} % for {more} more",
        value=per * change,
        uncertainty=per * uncertainty,
        place=path,
    )
