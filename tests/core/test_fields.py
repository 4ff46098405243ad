"""A field whose name a file cannot hold is refused when its class is made."""

import pytest
from testing.conformance.honest_laws import RunningIn

from tribo import Field

BAD = ["a/b", "", "a b", "1st", "\x1b[31m"]


def law(*names):
    fields = tuple(Field(name, "m", "Slid.") for name in names)
    return type("Slashed", (RunningIn,), {"state_fields": fields})


@pytest.mark.parametrize("name", BAD)
def test_a_law_that_names_it_so_is_not_made(name):
    with pytest.raises(TypeError, match=r"Slashed\.state_fields: .* cannot name a field") as error:
        law(name)
    assert repr(name) in str(error.value)


def test_a_law_that_names_two_alike_is_not_made():
    with pytest.raises(TypeError, match="the field 'slip' is declared twice"):
        law("slip", "slip")


@pytest.mark.parametrize("unit", ["mm", "", "µ"])
def test_a_field_in_another_unit_than_an_si_unit_is_not_made(unit):
    with pytest.raises(ValueError, match="unit"):
        Field("slid", unit, "Distance slid.")
