"""A quantity may be written with any unit of its dimension, and with no other."""

import math
from itertools import product
from typing import Annotated

import pint
import pytest
from pydantic import TypeAdapter, ValidationError

from tribo.core.errors import CaseError
from tribo.core.units import Quantity, parse

PINT = pint.UnitRegistry()

WRITTEN = [
    ("2.5 bar", "Pa"),
    ("1500 1/min", "Hz"),
    ("3.5 ft", "m"),
    ("3 lbf", "N"),
    ("14 psi", "Pa"),
    ("4 lb/ft^3", "kg/m^3"),
    ("700 kgf/mm^2", "Pa"),
    ("46 W/(m K)", "W/(m K)"),
    ("0.46 J/g/K", "J/(kg K)"),
    ("20 GPa/mm", "Pa/m"),
    ("90 degC", "K"),
    ("80 cP", "Pa s"),
    ("100 cSt", "m^2/s"),
]


@pytest.mark.parametrize(("text", "unit"), WRITTEN)
def test_conversion_agrees_with_pint(text, unit):
    number, _, written = text.partition(" ")
    expected = PINT.Quantity(float(number), written).to(unit if unit != "1" else "").magnitude
    # pint multiplies floats, which rounds more than once.
    assert parse(text, unit) == pytest.approx(expected, rel=1e-14, abs=0)


TIMES = ("e-7", "·10^-7", "x10^-7", " × 10^-7", "*10**-7", " · 10⁻⁷")
VOLUMES = ("mm^3", "mm3", "mm**3", "mm³")
BELOW = ("/(N m)", "/Nm", "/N.m", "/N·m", "/(N·m)", "/(N*m)", "/N/m", " N⁻¹ m⁻¹", "·N^-1·m^-1")


def test_every_spelling_of_a_quantity_is_the_same_float():
    for times, volume, below in product(TIMES, VOLUMES, BELOW):
        assert parse(f"3.11{times} {volume}{below}", "1/Pa") == 3.11e-16


@pytest.mark.parametrize(
    ("text", "unit", "exactly"),
    [
        ("1/4 in", "m", 0.00635),
        ("1/3", "1", 1 / 3),
        ("10⁻⁷ m", "m", 1e-7),
        ("−5.1 mm", "m", -5.1e-3),
        ("60 rpm", "Hz", 1.0),
        ("3 mN.m", "J", 3e-3),
        ("46 W/m·K", "W/(m K)", 46.0),
        ("241 HB", "Pa", 241 * 9806650.0),
        ("1e-3 m⁻¹", "1/m", 1e-3),
        ("90 °C", "K", 363.15),
        ("700 HV0.3", "Pa", 700 * 9806650.0),
        ("700HV30", "Pa", 700 * 9806650.0),
    ],
)
def test_conversion_rounds_once(text, unit, exactly):
    assert parse(text, unit) == exactly


@pytest.mark.parametrize(
    ("text", "unit", "message"),
    [
        ("5 s", "m", "'5 s' is a time [s]; a length [m] is needed, as in '5 mm'"),
        ("5", "m", "'5' has no unit"),
        ("5 m s", "m", "'5 m s' is a quantity in m s"),
        ("5 parsec", "m", "unknown unit 'parsec'; a length"),
        ("5 Gpa", "Pa", "'GPa'"),
        ("200 mpa", "Pa", "'MPa'"),
        ("5 hz", "Hz", "'Hz'"),
        ("5 w/(m k)", "W/(m K)", "'W/(m K)'"),
        ("46 W/m K", "W/(m K)", "put the divisor in parentheses"),
        ("2·103 N", "N", "a unit is missing"),
        ("5 laps", "m", "is a number of laps [lap]; a length [m] is needed, as in '5 mm'"),
        ("62 HRC", "Pa", "Rockwell hardness has no fixed conversion; give GPa or HV"),
        ("207,0 GPa", "Pa", "'207,0 GPa' is not a quantity; a pressure [Pa] is needed, as in"),
        ("5 degC/s", "K", "use K in a compound unit"),
        ("five mm", "m", "'five mm' is not a quantity; a length [m] is needed, as in '5 mm'"),
        ("1e999 m", "m", "is not finite"),
        ("1e99999999 m", "m", "e99999999"),
        ("9" * 200 + " m", "m", "is not a quantity"),
    ],
)
def test_what_is_no_such_quantity_is_refused(text, unit, message):
    with pytest.raises(CaseError) as caught:
        parse(text, unit)
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("quantity", "value", "message"),
    [
        (Quantity("Pa", above=0), "-207 GPa", "-207 GPa: must be greater than 0"),
        (Quantity("K", above=0), "-300 degC", "-300 degC: must be greater than 0 K"),
        (Quantity("m", at_least=0.5), "40 cm", "40 cm: must be at least 500 mm, as in"),
        (Quantity("m", below=1), 1, "1 m: must be less than 1 m"),
        (Quantity("m"), float("nan"), "nan m is not finite"),
        (Quantity("m"), 10**400, "is not finite"),
        (Quantity("m"), True, "true is not a quantity; a length [m] is needed, as in '5 mm'"),
        (Quantity("m"), [1], "a list is not a quantity"),
    ],
)
def test_a_field_refuses_with_a_plain_message(quantity, value, message):
    adapter = TypeAdapter(Annotated[float, quantity])
    with pytest.raises(ValidationError) as caught:
        adapter.validate_python(value)
    assert message in caught.value.errors()[0]["msg"]


@pytest.mark.parametrize(
    "quantity",
    [
        Quantity("Pa", above=0, usual=(1e4, 1e9)),
        Quantity("m", usual=(1e-10, 1e-4)),
        Quantity("1", above=0, at_most=0.01),
        Quantity("1", at_least=1),
        Quantity("m", at_least=-1e-3, at_most=1e-3),
    ],
)
def test_an_example_is_a_usual_value(quantity):
    low, high = quantity.usual or (-math.inf, math.inf)
    assert low <= quantity.read(quantity.example) <= high


def test_a_bound_that_is_included_is_allowed():
    assert Quantity("m", at_least=0).read(0) == 0
