"""Effects that answer nonsense."""

import numpy as np
import pytest
from zoo_keeper import Zoo, expect_harmless, expect_one_message

from tribo import CaseError, Effect, Field

ZOO = Zoo()


def bad(words):
    return ZOO.bad(words, saved=True)


class Heat(Effect):
    """A field of the pressure's shape for each body, and what is made of it."""

    provides = (Field("zoo_heat", "W/m^2", "Power per area."),)

    def fields(self, contact):
        return {"zoo_heat": {name: self.heat(contact.pressure) for name in contact.materials}}

    def heat(self, pressure):
        return pressure * 0.1


@bad("gave a NoneType instead of its fields")
class AnswersNothing(Heat):
    def fields(self, contact):
        return None


@bad("gave no 'zoo_heat' for body 'ball'")
class ForgetsTheField(Heat):
    def fields(self, contact):
        return {}


@bad("gave no 'zoo_heat' for body 'disk'")
class ForgetsABody(Heat):
    def fields(self, contact):
        return {"zoo_heat": {"ball": contact.pressure}}


@bad("gave no 'zoo_heat' for body 'ball'")
class AnswersNoBodies(Heat):
    def fields(self, contact):
        return {"zoo_heat": contact.pressure}


@bad("gave 'zoo_heat' for body 'ball' that is not an array of shape (32, 32): float64 of shape (31")
class WrongShape(Heat):
    def heat(self, pressure):
        return pressure[1:]


@bad("gave 'zoo_heat' for body 'ball' that is not finite in")
class NotANumber(Heat):
    def heat(self, pressure):
        return np.log(-pressure - 1.0)


@bad("complex128")
class Complex(Heat):
    def heat(self, pressure):
        return pressure * 1j


@bad("a str")
class Words(Heat):
    def heat(self, pressure):
        return "hot"


@bad("raised KeyError: 'steel'")
class Raises(Heat):
    def heat(self, pressure):
        raise KeyError("steel")


@bad("read-only")
class WritesIntoThePressure(Heat):
    def heat(self, pressure):
        pressure *= 0.1
        return pressure


def check(*given):
    raise TypeError("not these")


@ZOO.bad("raised TypeError: not these")
class CheckRaises(Heat):
    check = staticmethod(check)


@pytest.mark.filterwarnings("ignore:invalid value:RuntimeWarning")
@pytest.mark.parametrize("cls", ZOO.kept, ids=lambda cls: cls.__name__)
def test_it_ends_with_one_message(run, cls):
    expect_one_message(run(ZOO, cls), cls)


def test_what_an_effect_refuses_is_bad_input_at_its_place(run):
    zoo = Zoo()

    @zoo.bad("", code=2)
    class Refuses(Heat):
        def check(self, materials, swept):
            raise CaseError("needs a conductivity")

    ended = run(zoo, Refuses)
    assert (ended.code, ended.said) == (2, ["error: effects: needs a conductivity"])


def test_one_that_does_not_say_what_it_provides_is_not_loaded():
    zoo = Zoo()

    @zoo.bad("", code=2)
    class Mute(Effect):
        def fields(self, contact):
            return {}

    with pytest.raises(TypeError, match="Mute does not define provides, a tuple of Field"):
        zoo.registry()


def test_one_that_provides_a_field_with_a_slash_is_not_made():
    with pytest.raises(TypeError, match=r"Slashed\.provides: 'power/area' cannot name a field"):

        class Slashed(Heat):
            provides = (Field("power/area", "W/m^2", "Power per area."),)


def test_none_harms_a_case_that_names_another(run):
    expect_harmless(run(ZOO))
