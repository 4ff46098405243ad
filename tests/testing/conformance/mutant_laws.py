"""Wrong wear laws, and what is wrong with the configuration of any component."""

import sys
from dataclasses import replace
from itertools import count
from os import getpid
from types import ModuleType
from typing import Annotated

import numpy as np
from pydantic import ConfigDict, field_validator, model_serializer
from testing.conformance.honest import Hill, Law

from tribo import Field, Quantity
from tribo.testing.compare import CheckFailed

LAWS = []
"""The check that must fail, the class, and what is raised."""
NUMBERS = count()


def wrong(honest, *mistakes):
    """Return mutants of an honest class, given the check that each fails, its parts, its error."""
    return [
        (
            check,
            type(f"{honest.__name__}{next(NUMBERS)}", (honest,), {"__module__": __name__, **parts}),
            raising[0] if raising else CheckFailed,
        )
        for check, parts, *raising in mistakes
    ]


# The configuration, by the example of a wear law.


class WithoutUnit(Law):
    q: float = 3.0
    """Something."""


class Undescribed(Law):
    q: Annotated[float, Quantity("1")] = 3.0
    # Reads no docstring of the field above it.
    model_config = ConfigDict(use_attribute_docstrings=False)


class MillimetresEachTime(Law):
    q: Annotated[float, Quantity("m")] = 3.0
    """A length in mm."""

    @field_validator("q")
    @classmethod
    def _to_metres(cls, value):
        return 1e-3 * value


class AnotherWithoutDefaults(Law):
    @model_serializer(mode="wrap")
    def _short(self, handler, info):
        return {**handler(self), **({"k": 2e-16} if info.exclude_defaults else {})}


def _local():
    class Unreachable(Law):
        """A class that no other process can find."""

    return Unreachable


# Another process that imports this file makes a module of another name.
here = sys.modules[f"only_in_{getpid()}"] = ModuleType("here")
here.OnlyHere = type("OnlyHere", (Law,), {"__module__": f"only_in_{getpid()}"})

LAWS += [
    ("quantities_have_units", WithoutUnit, CheckFailed),
    ("fields_are_described", Undescribed, CheckFailed),
    ("configuration_survives_a_file", MillimetresEachTime, CheckFailed),
    ("configuration_survives_a_file", AnotherWithoutDefaults, CheckFailed),
    ("configuration_can_be_pickled", _local(), CheckFailed),
    ("configuration_can_be_pickled", here.OnlyHere, CheckFailed),
]
LAWS += wrong(
    Law,
    ("objects_are_frozen_and_know_their_keys", {"model_config": {"frozen": False}}),
    ("objects_are_frozen_and_know_their_keys", {"model_config": {"extra": "ignore"}}),
    ("name_has_a_prefix", {"type": "law"}),
    ("facts_are_text_and_stay", {"facts": lambda self: {"size": 1.24e-3}}),
)

# Calls that are not pure.


def rate(change):
    """Return a `rate` that differs from the honest law's by `change` of it and its conditions."""
    return lambda self, local: change(Law.rate(self, local), local)


def drawing_numpy(self, grid):
    return Hill.height(self, grid) + 0 * np.random.rand()  # noqa: NPY002


LAWS += wrong(Law, ("nothing_is_printed", {"rate": rate(lambda r, local: print("rate") or r)}))
LAWS += wrong(Hill, ("no_global_random_numbers", {"height": drawing_numpy}))


# Wear laws.


def parts(change):
    """Return a `rate` of which `change` of it and its conditions gives other parts."""
    return {"rate": rate(lambda r, local: replace(r, **change(r, local)))}


def falling(rate, local):
    fall = np.where(local.pressure > 1e9, 1e9 / np.maximum(local.pressure, 1.0), 1.0)
    return {"depth_rate": rate.depth_rate * fall**4}


def failing_later(rate, local):
    if local.pressure.shape == (24, 20) and local.state["rubbed"].max() > 0:
        raise RuntimeError("too far")
    return {}


def asking(rate, local):
    return {"depth_rate": rate.depth_rate * local.fields.get("temperature", 300.0)}


LAWS += wrong(
    Law,
    ("depth_grows_with_pressure", parts(falling)),
    ("only_declared_fields_are_asked_for", parts(asking)),
    ("declared_fields_have_units", {"state_fields": (Field("rubbed", "mm", "Distance slid."),)}),
    ("runs_under_implicit_stepping", parts(failing_later), RuntimeError),
)
