"""Wrong motions."""

import numpy as np
from testing.conformance.caught import caught_by
from testing.conformance.honest import Motion

from tribo.plugin import Grid, NumericalError, Stationary, Track


@caught_by("motion_ends")
class Endless(Motion):
    @property
    def end_time(self):
        return np.inf


@caught_by("path_begins_at_zero")
class RunsIn(Motion):
    def distance_at(self, time):
        return super().distance_at(time) + 1e-3


@caught_by("path_never_shrinks")
class PositionAsPath(Motion):
    def distance_at(self, time):
        return abs(np.sin(time)) + time / 2


@caught_by("time_inverts_distance")
class CountsHalfCycles(Motion):
    def time_at(self, distance):
        return 2 * super().time_at(distance)


@caught_by("cycles_add_up")
class SlowsDown(Motion):
    def distance_at(self, time):
        return np.sqrt(1 + time) - 1

    def time_at(self, distance):
        return (distance + 1) ** 2 - 1


@caught_by("every_body_is_exposed")
class ForgetsABody(Motion):
    def exposures(self, grid, bodies):
        return {bodies[1]: Track(grid, self.stroke)}


@caught_by("body_fields_fit_the_window")
class DropsAnAxis(Motion):
    class track(Track):  # noqa: N801
        def average(self, rate):
            return super().average(rate)[0]


@caught_by("worn_volume_is_conserved")
@caught_by("runs_a_case", NumericalError)
class MeanOverTheWindow(Motion):
    class track(Track):  # noqa: N801
        def average(self, rate):
            return np.mean(rate, axis=0, keepdims=True)


@caught_by("what_passes_is_swept")
class PassesUnsaid(Motion):
    class track(Track):  # noqa: N801
        swept = False


@caught_by("averages_are_linear")
class MeanSquare(Motion):
    class track(Track):  # noqa: N801
        def average(self, rate):
            return np.sqrt(super().average(rate**2))


@caught_by("finer_window_averages_the_same")
class CountsCells(Motion):
    class track(Track):  # noqa: N801
        def average(self, rate):
            return super().average(rate) * rate.shape[0] / 24


@caught_by("envelope_covers_the_field")
class AverageAsEnvelope(Motion):
    class track(Track):  # noqa: N801
        def envelope(self, field):
            return self.average(field)


@caught_by("compliance_is_the_average_of_a_linear_law")
class SweptAsLocal(Motion):
    class track(Track):  # noqa: N801
        def compliance(self, derivative, pressure):
            return Stationary(Grid((1.0, 1.0), derivative.shape)).compliance(derivative, pressure)


@caught_by("limitation_is_said_in_words")
class SaysYes(Motion):
    def limitation(self, grid, half_width_x):
        return half_width_x > 1e-3


@caught_by("runs_a_case", NumericalError)
class StandsStill(Motion):
    def time_at(self, distance):
        return super().time_at(distance) if distance == 0 or distance > 2.9 else 0.0
