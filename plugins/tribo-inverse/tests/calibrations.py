"""The paper's test on springs and a small grid, in long steps: to calibrate in little time."""

import tomllib
from copy import deepcopy

import numpy as np
from tribo.config.overrides import apply_settings
from tribo.templates import template

from tribo_inverse.calibration.linearised import Problem

SPRINGS = {
    "contact": {"type": "winkler"},
    "stepping": {"type": "implicit", "depth_tolerance": 0.1, "pressure_tolerance": 0.3},
    "output": {},
}


def on_springs(name, settings):
    """Return the case of a template on springs, with more settings."""
    return apply_settings(tomllib.loads(template(name)), deepcopy(SPRINGS) | settings)


def cheap(duration):
    """Return the paper's test as it is cheap to run, for a time in s."""
    grid = {"size": "1 mm", "cells": 16}
    return on_springs("ball_on_disk", {"grid": grid, "kinematics.duration": duration})


def of_kind(found, kind):
    """Return what was found of a kind."""
    return [each for each in found.findings if each.kind == kind]


def problem(
    observed,
    sigma,
    *,
    names=("ball", "disk"),
    reach=np.inf,
    start=1.0,
    **data,
):
    """A problem of which the first responses are data, the others predictions."""
    n = len(observed)
    each = {"specimen": np.arange(n), "repeatability": 0.0} | data
    start = np.log(np.broadcast_to(start, len(names)))
    return Problem(names, observed, sigma, *each.values(), start - reach, start + reach)
