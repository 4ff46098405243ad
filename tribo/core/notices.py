"""Notices, which a run gives its user once each."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

Kind = Literal[
    "begin",
    "positions",
    "quadrature",
    "stability",
    "averaging",
    "chattering",
    "lap",
    "period",
    "resolution",
    "layer",
    "stop",
    "failed",
]


@dataclass(frozen=True)
class Notice:
    """A message about a run: what is to be known, and what to do.

    The kind ``"begin"`` says what a run began with, ``"stop"`` and ``"failed"`` why it ended. It
    holds from a time (s) and sliding distance (m) on; of the whole run where these are None. One of
    the kind ``"layer"`` is about a body and its layer, counted from 1.
    """

    kind: Kind
    text: str
    time: float | None = None
    distance: float | None = None
    body: str | None = None
    layer: int | None = None

    def __str__(self) -> str:
        """Return the sentence that results keep."""
        if self.time is None or self.distance is None:
            return f"{self.kind}: {self.text}"
        time, distance = (f"{float(f'{value:.4g}'):g}" for value in (self.time, self.distance))
        return f"{self.kind}: at {time} s ({distance} m) {self.text}"


def worn_through(notices: Iterable[Notice]) -> list[dict[str, str | int | float | None]]:
    """Return which layers of which bodies were worn through, and when, as plain data."""
    return [
        {
            "body": notice.body,
            "layer": notice.layer,
            "distance_m": notice.distance,
            "time_s": notice.time,
        }
        for notice in notices
        if notice.kind == "layer"
    ]
