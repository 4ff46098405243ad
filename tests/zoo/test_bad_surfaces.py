"""Surfaces that are no shape."""

import numpy as np
import pytest
from zoo_keeper import Zoo, expect_harmless, expect_one_message

from tribo import CaseError
from tribo.surfaces.sphere import Sphere

ZOO = Zoo(radius=(float, 5e-3))
bad = ZOO.bad


@bad(
    "surface 'zoo.wrong_shape' of body 'ball' gave a height map that is not an array of shape "
    "(32, 32): float64 of shape (32, 1)"
)
class WrongShape(Sphere):
    def height(self, grid):
        return super().height(grid)[:, :1]


@bad("a height map that is not finite in 1 cells")
class NotANumber(Sphere):
    def height(self, grid):
        height = super().height(grid)
        height[0, 0] = np.nan
        return height


@bad("complex128")
class Complex(Sphere):
    def height(self, grid):
        return super().height(grid) + 1e-9j


@bad("a NoneType")
class Nothing(Sphere):
    def height(self, grid):
        return None


@bad("a list")
class Ragged(Sphere):
    def height(self, grid):
        return [[0.0], [0.0, 0.0]]


@bad("a curvature that is not an array of shape (2,): 3")
class OneCurvature(Sphere):
    @property
    def curvature(self):
        return 3


@bad("a curvature that is not finite in 1 cells")
class CurvatureNotANumber(Sphere):
    @property
    def curvature(self):
        return 200.0, np.nan


@bad("a curvature that is not an array of shape (2,): a str")
class CurvatureInWords(Sphere):
    @property
    def curvature(self):
        return "round"


@bad("raised AttributeError")
class CurvatureRaises(Sphere):
    @property
    def curvature(self):
        return self.no_such_thing


@bad("raised FileNotFoundError: scan.opd")
class Raises(Sphere):
    def height(self, grid):
        raise FileNotFoundError("scan.opd")


@bad("raised AssertionError and says no more")
class Asserts(Sphere):
    @staticmethod
    def height(grid):
        raise AssertionError


@bad("raised CaseError and says no more")
class RefusesWithoutAWord(Sphere):
    def height(self, grid):
        raise CaseError("")


@pytest.mark.parametrize("cls", ZOO.kept, ids=lambda cls: cls.__name__)
def test_it_ends_with_one_message(run, cls):
    expect_one_message(run(ZOO, cls), cls)


def test_what_a_surface_refuses_is_bad_input_at_its_place(run):
    zoo = Zoo()

    @zoo.bad("", code=2)
    class Refuses(Sphere):
        def height(self, grid):
            raise CaseError("the scan is smaller than the window")

    ended = run(zoo, Refuses, surface='{ type = "zoo.refuses", radius = 0.005 }')
    assert ended.said == ["error: bodies.ball.surface: the scan is smaller than the window"]
    assert ended.code == 2


def test_none_harms_a_case_that_names_another(run):
    expect_harmless(run(ZOO))
