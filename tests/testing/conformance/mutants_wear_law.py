"""Wrong wear laws."""

from dataclasses import replace

import numpy as np
from testing.conformance.caught import caught_by
from testing.conformance.honest import Law

from tribo.core.errors import PluginError
from tribo.plugin import Field


@caught_by("rates_are_finite_arrays")
class ScalarDerivative(Law):
    def rate(self, local):
        return replace(super().rate(local), depth_slope=1e-16)


@caught_by("rates_are_finite_arrays")
class SinglePrecision(Law):
    def rate(self, local):
        rate = super().rate(local)
        return replace(rate, depth_rate=rate.depth_rate.astype(np.float32))


@caught_by("rates_are_finite_arrays")
class DividesByZero(Law):
    def rate(self, local):
        with np.errstate(invalid="ignore"):
            return replace(super().rate(local), depth_slope=local.pressure / local.pressure)


@caught_by("nothing_wears_without_pressure")
class WearsByItself(Law):
    def rate(self, local):
        rate = super().rate(local)
        return replace(rate, depth_rate=rate.depth_rate + 1e-12)


@caught_by("wear_only_removes")
class Grows(Law):
    def rate(self, local):
        rate = super().rate(local)
        return replace(rate, depth_rate=-rate.depth_rate, depth_slope=-rate.depth_slope)


@caught_by("derivative_is_that_of_the_depth")
class SecantAsDerivative(Law):
    def rate(self, local):
        rate = super().rate(local)
        touching = np.where(local.pressure > 0, local.pressure, 1.0)
        return replace(rate, depth_slope=rate.depth_rate / touching)


@caught_by("depth_grows_with_pressure")
class FallsUnseen(Law):
    def rate(self, local):
        rate = super().rate(local)
        fall = np.where(local.pressure > 1e9, 1e9 / np.maximum(local.pressure, 1.0), 1.0)
        return replace(rate, depth_rate=rate.depth_rate * fall**4)


@caught_by("points_are_independent")
class Normalised(Law):
    def rate(self, local):
        rate = super().rate(local)
        return replace(rate, depth_rate=rate.depth_rate * np.mean(local.pressure) / 1e9)


@caught_by("points_are_independent")
class AveragesItself(Law):
    def rate(self, local):
        rate = super().rate(local)
        mean = np.mean(rate.depth_rate, axis=0, keepdims=True)
        return replace(rate, depth_rate=np.where(local.pressure > 0, mean, 0.0))


@caught_by("only_declared_fields_are_asked_for")
class AsksForMore(Law):
    def rate(self, local):
        warm = local.fields.get("temperature", 300.0)
        rate = super().rate(local)
        return replace(rate, depth_rate=rate.depth_rate * (warm / 300))


@caught_by("every_state_field_has_a_rate")
class ForgetsItsState(Law):
    def rate(self, local):
        return replace(super().rate(local), state_rates={})


@caught_by("state_fields_are_declared")
class StateInMillimetres(Law):
    state_fields = (Field("rubbed", "mm", "Distance slid under pressure."),)


@caught_by("runs_under_implicit_stepping", PluginError)
class FailsLaterOn(Law):
    def rate(self, local):
        if local.pressure.shape == (24, 20) and local.state["rubbed"].max() > 0:
            raise RuntimeError("too far")
        return super().rate(local)
