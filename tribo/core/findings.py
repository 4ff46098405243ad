"""Findings on a case or a run, as data and in words."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, replace

from tribo.core.words import readable

NOTHING_WRONG = ("begin", "layer", "stop")
"""Kinds that report what the case itself asks for."""
FEW_CELLS = 8
"""Cells across a contact, below which its pressure is inaccurate: Hertz's largest is within
1.5 % with 8 cells, 4 % with 4."""
DEEP = 0.1
"""Part of the window's edge or of a radius that wear may reach, as slopes are small: a tenth is
6°."""
FAST, IMPOSSIBLE = 1e-9, 1e-5
"""Specific wear rates in 1/Pa: K = kH = 0.1, the most in abrasive wear, at H = 100 MPa, and
Archard's K ≤ 1 at 0.1 MPa."""
SHORT = 6.0
"""Half-widths of the contact under which an average over a stroke is reported: grooves as deep as
the approach are 7 % too deep there, deeper ones 15 % (`benchmarks/studies/moving_contact.py`)."""


@dataclass(frozen=True)
class Finding:
    """A finding on a case, a run or a fit: a warning, or what the case itself asks for.

    Parameters
    ----------
    kind : str
        What it is about, in a word or two, such as ``"averaging"``.
    words : str
        What was found, and what to do.
    value, uncertainty, limit : float, optional
        The number that it is about, in SI units, and the limit of this number.
    place : str, optional
        Where in the case, as its path or the name of a body; empty for all of it.
    time, distance : float, optional
        From when on it holds, in s, and from which sliding distance on, in m.

    Examples
    --------
    >>> found = tribo.Finding("flash", "the contact is above 600 °C", value=905.0, limit=873.15)
    >>> print(found.at(time=60.0, distance=6.0))
    flash: at 60 s (6 m) the contact is above 600 °C
    """

    kind: str
    words: str
    value: float | None = None
    uncertainty: float | None = None
    limit: float | None = None
    place: str = ""
    time: float | None = None
    distance: float | None = None

    def __str__(self) -> str:
        """Return the sentence that is printed for a run."""
        if self.time is None or self.distance is None:
            return f"{self.kind}: {self.words}"
        time, distance = (f"{float(f'{value:.4g}'):g}" for value in (self.time, self.distance))
        return f"{self.kind}: at {time} s ({distance} m) {self.words}"

    @property
    def is_warning(self) -> bool:
        """Whether it is more than what the case asks for."""
        return self.kind not in NOTHING_WRONG

    def at(self, time: float, distance: float) -> Finding:
        """Return the finding from a time (s) and sliding distance (m) on."""
        return replace(self, time=time, distance=distance)


def few_cells(cells: int) -> Finding:
    """Word a contact of only a few cells."""
    return Finding(
        "resolution",
        f"the contact is only {cells} cells wide, so its pressure is inaccurate: raise "
        f"grid.cells until it is {FEW_CELLS} cells wide",
        value=cells,
        limit=FEW_CELLS,
        place="grid.cells",
    )


def broken_period(body: str, along: str, jump: float) -> Finding:
    """Word a surface with a jump (m) where the contact repeats along an axis."""
    return Finding(
        "period",
        f"the surface of {body} does not repeat with the window: along {along} it "
        f"jumps by {1e9 * jump:.3g} nm (root mean square) from one period to the next, "
        "and presses there; give it a period of the window's length or a part of it",
        value=jump,
        limit=0.0,
        place=f"bodies.{body}.surface",
    )


def too_deep(body: str, depth: float, size: float) -> Finding:
    """Word a wear depth that is no small part of a length of the contact, both in m."""
    words = (
        f"{body} is worn {1e6 * depth:.4g} µm deep, more than {DEEP:g} of {1e6 * size:.4g} µm, the "
        "smallest of its radii, the window's edges and an elastic layer; at the whole of it a run "
        "stops"
    )
    return Finding("depth", words, value=depth, limit=DEEP * size, place=f"bodies.{body}")


def too_fast(body: str, rate: float) -> Finding:
    """Word a specific wear rate (1/Pa) that no test has."""
    words = (
        f"the specific wear rate of {body} is {1e9 * rate:.4g} mm³/(N m), above {1e9 * FAST:g}; at "
        f"{1e9 * IMPOSSIBLE:g} a run stops: is the unit of a wear coefficient wrong or missing?"
    )
    return Finding("wear rate", words, value=rate, limit=FAST, place=f"bodies.{body}")


def unusual(place: str, question: str, value: float, limit: float) -> Finding:
    """Word a value of the case that is beyond a usual limit."""
    return Finding("unusual", f"{place} is {question}", value=value, limit=limit, place=place)


def short_stroke(stroke: float, half_width: float) -> Finding:
    """Word an average over a stroke of few half-widths of the contact, both in m."""
    widths = stroke / half_width
    words = (
        f"tribo averages over the stroke, {1e3 * stroke:.3g} mm or {widths:.2g} half-widths of the "
        "contact; where both bodies wear alike, a groove is 7 to 15 % too deep at mid-stroke for "
        f"{SHORT:g} half-widths, 12 to 24 % for 4 and 62 % for 1.8: resolve the stroke by "
        'kinematics.positions = "auto"'
    )
    return Finding("averaging", words, value=widths, limit=SHORT, place="kinematics")


def short_track(track: float, width: float) -> Finding:
    """Word a track on which a contact meets itself, both lengths in m."""
    words = (
        f"the track of {1e3 * track:.3g} mm is shorter than the contact of {1e3 * width:.3g} mm, "
        "which meets itself on it: lengthen the track"
    )
    return Finding("averaging", words, value=track, limit=width, place="kinematics")


def unlike_the_period(body: str, length: float, period: float) -> Finding:
    """Word a track averaged over a length other than the period of an endless contact, in m."""
    return Finding(
        "averaging",
        f"the contact repeats every {1e3 * period:.4g} mm without an end, but the wear of "
        f"{body} by one period is averaged over a track of {1e3 * length:.4g} mm: "
        f"{body} wears {period / length:.3g} times as much as it would; make the track "
        'as long as the window, or resolve a stroke by kinematics.positions = "cells"',
        value=length,
        limit=period,
        place=f"bodies.{body}",
    )


def layer_worn_through(body: str, layer: int, bottom: float) -> Finding:
    """Word a layer, counted from 1, whose bottom (m) the deepest point passes."""
    return Finding(
        "layer",
        f"layer {layer} of {body}, down to {1e6 * bottom:.4g} µm, is worn through at its "
        "deepest point",
        value=bottom,
        place=f"bodies.{body}.layers.{layer}",
    )


def begun_worn(result: str, time: float, afresh: Sequence[str], left: Sequence[str]) -> Finding:
    """Word a begin with the bodies of a result at a time (s), and states that differ from it."""
    return Finding(
        "begin",
        f"the bodies begin as worn as in {result} at {time:g} s; wear depths, "
        "volumes and load_distance continue from there, time and distance start at 0"
        + (f"; states that it lacks start afresh: {', '.join(afresh)}" if afresh else "")
        + (f"; not taken from it: {', '.join(left)}" if left else ""),
        place="begin",
    )


def ended(time: float, depth: float, limit: float) -> Finding:
    """Word the end of a run at a time (s), with its wear depth beside stop.depth, both in m."""
    words, most = f"ended at {time:.6g} s", f"{1e6 * limit:.4g} µm"
    if depth >= limit:
        words += f", where the wear depth reached {most}"
    else:
        words += f" with a wear depth of {1e6 * depth:.4g} µm; stop.depth, {most}, is not reached"
    return Finding("stop", words, value=depth, limit=limit, place="stop.depth")


def outgrown(size: tuple[float, float], time: float | None, end: float) -> Finding:
    """Word a window (m) that the contact outgrows at a time before the end, both in s."""
    lx, ly = (1e3 * edge for edge in size)
    when = "" if time is None else f", at about {readable(time, '.3g')} s"
    return Finding(
        "window",
        f"the contact outgrows the window of {lx:.4g} × {ly:.4g} mm, and the run would "
        f"stop there{when}: make grid.size larger (and grid.cells with it)",
        value=time,
        limit=end,
        place="grid.size",
    )


def trial_failed(error: object, *, on_any_cells: bool) -> Finding:
    """Word a trial run that failed on a coarse grid; a finer grid may succeed."""
    may = "" if on_any_cells else " (the run, on finer cells, may still succeed)"
    return Finding("trial", f"a trial run on a coarse grid failed{may}: {error}")


def other_grid(labels: Sequence[str], reference: str) -> Finding:
    """Word results on another grid than the reference result."""
    return Finding(
        "grid",
        f"{', '.join(labels)}: not on the grid of {reference}; maps are compared by "
        "interpolation where both windows reach",
    )


def not_done(label: str, status: str) -> Finding:
    """Word a run that did not finish."""
    return Finding("status", f"{label} is {status}, not done")


def of_runs(finding: Finding, labels: Sequence[str]) -> Finding:
    """Word a finding of several runs."""
    return replace(finding, words=f"{'; '.join(labels)}: {finding}")


def failed(error: BaseException) -> Finding:
    """Word the error that ended a run, with the numbers of its finding, if any."""
    finding = getattr(error, "finding", Finding("failed", ""))
    return replace(finding, kind="failed", words=str(error))


def damaged(damage: str) -> Finding:
    """Word a checkpoint that could not be read."""
    return Finding("checkpoint", f"{damage}; this is the state of the checkpoint before it")


def as_json(findings: Iterable[Finding]) -> str:
    """Return findings as JSON for a file."""
    return json.dumps([asdict(each) for each in findings])
