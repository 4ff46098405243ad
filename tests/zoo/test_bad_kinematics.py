"""Motions that do not move as they say, and exposures that answer nonsense."""

import numpy as np
import pytest
from zoo_keeper import Zoo, expect_harmless, expect_one_message

from tribo import NumericalError, Stationary, Track, WearCompliance
from tribo.motion.unidirectional import Unidirectional

PATH = {"speed": (float, 0.1), "track_length": (float, 0.02), "distance": (float, 2.0)}
ZOO, GROOVES = Zoo(**PATH), Zoo(**PATH)
bad = ZOO.bad


@bad("to -2 m; it must slide on from 0")
class Backwards(Unidirectional):
    def distance_at(self, time):
        return -super().distance_at(time)


@bad("slides from 1 m")
class BeginsSomewhere(Unidirectional):
    def distance_at(self, time):
        return 1 + super().distance_at(time)


@bad("slides from 0 m to 0 m")
class StandsStill(Unidirectional):
    def distance_at(self, time):
        return 0.0


@bad("a distance at 0 s that is not a finite number: a NoneType")
class NoPath(Unidirectional):
    def distance_at(self, time):
        return None


@bad("that is not a finite number: nan")
class PathNotANumber(Unidirectional):
    def distance_at(self, time):
        return np.nan * time


@bad("an end that is not a finite number: inf")
class Endless(Unidirectional):
    @property
    def end_time(self):
        return np.inf


@bad("ends at -3 s, before it begins")
class EndsBefore(Unidirectional):
    @property
    def end_time(self):
        return -3.0


@bad("time is not the inverse of its distance")
class TimeIsNoInverse(Unidirectional):
    def time_at(self, distance):
        return 0.5 * super().time_at(distance)


@bad("a time at 0.25 m that is not a finite number: a str")
class TimeInWords(Unidirectional):
    def time_at(self, distance):
        return "soon"


@bad("gave exposures of a NoneType, but the bodies are ['ball', 'disk']")
class NoExposures(Unidirectional):
    def exposures(self, grid, bodies):
        return None


@bad("gave exposures of ['ball'], but the bodies are ['ball', 'disk']")
class ForgetsABody(Unidirectional):
    def exposures(self, grid, bodies):
        return {"ball": Stationary(grid)}


@bad("as exposure of body 'disk'")
class ExposesAClass(Unidirectional):
    def exposures(self, grid, bodies):
        return {"ball": Stationary(grid), "disk": Track}


@bad("raised ZeroDivisionError")
class CannotExpose(Unidirectional):
    def exposures(self, grid, bodies):
        return 1 / 0


@bad("does not slide on", saved=True)
class TurnsBack(Unidirectional):
    """It does so between the times that are tried at first."""

    def distance_at(self, time):
        return super().distance_at(time) if abs(time - 7) > 0.1 else 0.0


@bad("raised OverflowError: too late", saved=True)
class StopsInTheMiddle(Unidirectional):
    def distance_at(self, time):
        if abs(time - 7) < 0.1:
            raise OverflowError("too late")
        return super().distance_at(time)


@bad("puts 0.", saved=True)
class LosesTheTime(Unidirectional):
    def time_at(self, distance):
        return super().time_at(distance) if 80 * distance % 1 == 0 else 0.0


@bad("gave a int as its limitation")
class LimitedByANumber(Unidirectional):
    def limitation(self, *track):
        return 7


def bad_exposure(words, zoo=ZOO, *, saved=False):
    """Make of an exposure a motion that gives it to the first body."""

    def keep(exposure):
        def exposures(self, grid, bodies):
            disk = Track(grid, 0.02)
            return {bodies[0]: exposure(grid), bodies[1]: disk}

        return zoo.bad(words, saved=saved)(
            type(exposure.__name__, (Unidirectional,), {"exposures": exposures})
        )

    return keep


@bad_exposure("for body 'ball', gave an average that is not an array of shape (32, 32): a NoneType")
class AverageNothing(Stationary):
    def average(self, rate):
        return None


@bad_exposure("gave an average that is not an array of shape (32, 32): float64 of shape (1, 32)")
class AverageOfATrackThatStays(Stationary):
    def average(self, rate):
        return rate[:1]


@bad_exposure("gave an average that is not an array of shape (1, 32): float64 of shape (32, 32)")
class AverageOfABodyThatPasses(Stationary):
    swept = True


@bad_exposure("gave an average that is not finite")
class AverageNotANumber(Stationary):
    def average(self, rate):
        return np.where(rate > 0, np.nan, rate)


@bad_exposure("gave a negative average")
class AverageNegative(Stationary):
    def average(self, rate):
        return -np.abs(rate)


@bad_exposure("read-only")
class AverageWritesIntoTheRate(Stationary):
    def average(self, rate):
        rate *= 2
        return rate


def helper():
    raise IndexError("out of the track")


@bad_exposure("raised IndexError: out of the track")
class AverageRaises(Stationary):
    @staticmethod
    def average(rate):
        return helper()


@bad_exposure("gave an envelope that is not an array of shape (32, 32)", GROOVES, saved=True)
class EnvelopeOfWrongShape(Stationary):
    def envelope(self, field):
        return field[1:]


@bad_exposure("gave an envelope that is not finite", GROOVES, saved=True)
class EnvelopeNotANumber(Stationary):
    def envelope(self, field):
        return field * np.nan


@bad_exposure("gave a volume that is not a finite number: float64 of shape (32,)")
class VolumeIsAnArray(Stationary):
    def volume(self, depth):
        return np.sum(depth, axis=0)


@bad_exposure("gave a volume that is not a finite number: nan")
class VolumeNotANumber(Stationary):
    def volume(self, depth):
        return np.nan


@bad_exposure("gave a ndarray instead of a WearCompliance", saved=True)
class ComplianceIsAnArray(Stationary):
    def compliance(self, derivative, pressure):
        return derivative


@bad_exposure("gave a local compliance that is not an array of shape (32, 32)", saved=True)
class ComplianceOfWrongShape(Stationary):
    def compliance(self, derivative, pressure):
        return WearCompliance(derivative[1:], np.zeros(32))


@bad_exposure("gave a swept compliance that is not finite in 32 cells", saved=True)
class ComplianceNotANumber(Stationary):
    def compliance(self, derivative, pressure):
        return WearCompliance(derivative, np.full(32, np.nan))


@bad_exposure("gave a negative compliance", saved=True)
class ComplianceNegative(Stationary):
    def compliance(self, derivative, pressure):
        return WearCompliance(-derivative, np.zeros(32))


@bad_exposure("raised NumericalError and says no more", saved=True)
class ComplianceRaises(Stationary):
    def compliance(self, derivative, pressure):
        raise NumericalError("")


@pytest.mark.parametrize("cls", ZOO.kept, ids=lambda cls: cls.__name__)
def test_it_ends_with_one_message(run, cls):
    expect_one_message(run(ZOO, cls), cls)


@pytest.mark.parametrize("cls", GROOVES.kept, ids=lambda cls: cls.__name__)
def test_it_is_asked_for_an_envelope_where_a_groove_is_drawn(run, cls):
    expect_one_message(run(GROOVES, cls, disk='hardness = "2 GPa"'), cls)


def test_none_harms_a_case_that_names_another(run):
    expect_harmless(run(ZOO))
