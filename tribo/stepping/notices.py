"""Warnings that a run gives once each."""

from __future__ import annotations

from dataclasses import replace

from tribo.core.state import State

STABILITY = "stability"
AVERAGING = "averaging"
CHATTERING = "chattering"


def told(state: State, kind: str, words: str) -> State:
    """Return `state` with a warning of what begins here, unless it has one of that kind."""
    if is_told(state, kind):
        return state
    return replace(state, notices=(*state.notices, sentence(state, kind, words)))


def is_told(state: State, kind: str) -> bool:
    """Whether a warning of this kind was given."""
    return any(notice.startswith(f"{kind}:") for notice in state.notices)


def sentence(state: State, kind: str, words: str) -> str:
    """Return a warning of what begins at `state`."""
    time, distance = (f"{float(f'{value:.4g}'):g}" for value in (state.time, state.distance))
    return f"{kind}: at {time} s ({distance} m) {words}"
