"""The paper's test on springs and a small grid, in long steps: to calibrate in little time."""

import tomllib

from tribo.config.overrides import apply_settings
from tribo.templates import template

SPRINGS = {
    "contact": {"type": "winkler"},
    "stepping": {"type": "implicit", "depth_tolerance": 1e-2, "pressure_tolerance": 0.3},
    "output": {},
}


def on_springs(name, settings):
    """Return the case of a template on springs, with more settings."""
    return apply_settings(tomllib.loads(template(name)), SPRINGS | settings)


def cheap(duration):
    """Return the paper's test as it is cheap to run, for a time in s."""
    grid = {"size": "1 mm", "cells": 24}
    return on_springs("ball_on_disk", {"grid": grid, "kinematics.duration": duration})
