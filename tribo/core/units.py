"""Quantities: floats in SI, which a case may write with any unit."""

from __future__ import annotations

import math
import operator
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache
from numbers import Real
from typing import Any, get_args, get_origin

from pydantic import GetCoreSchemaHandler
from pydantic.fields import FieldInfo
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from tribo.core.errors import CaseError
from tribo.core.rounding import ROUND_OFF
from tribo.core.words import did_you_mean, shown

Dimension = tuple[int, int, int, int, int, int]
"""Exponents of m, kg, s, K, mol and lap."""

_SYMBOLS: dict[str, tuple[str, Dimension]] = {
    "m": ("1", (1, 0, 0, 0, 0, 0)),
    "g": ("1e-3", (0, 1, 0, 0, 0, 0)),
    "s": ("1", (0, 0, 1, 0, 0, 0)),
    "K": ("1", (0, 0, 0, 1, 0, 0)),
    "mol": ("1", (0, 0, 0, 0, 1, 0)),
    "Hz": ("1", (0, 0, -1, 0, 0, 0)),
    "N": ("1", (1, 1, -2, 0, 0, 0)),
    "Pa": ("1", (-1, 1, -2, 0, 0, 0)),
    "bar": ("1e5", (-1, 1, -2, 0, 0, 0)),
    "J": ("1", (2, 1, -2, 0, 0, 0)),
    "P": ("0.1", (-1, 1, -1, 0, 0, 0)),
    "St": ("1e-4", (2, 0, -1, 0, 0, 0)),
    "W": ("1", (2, 1, -3, 0, 0, 0)),
    "Nm": ("1", (2, 1, -2, 0, 0, 0)),
}
"""Symbols that take a prefix."""
_UNPREFIXED: dict[str, tuple[str, Dimension]] = {
    "1": ("1", (0, 0, 0, 0, 0, 0)),
    **dict.fromkeys(("min", "minute", "minutes"), ("60", (0, 0, 1, 0, 0, 0))),
    **dict.fromkeys(("h", "hour", "hours"), ("3600", (0, 0, 1, 0, 0, 0))),
    **dict.fromkeys(("day", "days"), ("86400", (0, 0, 1, 0, 0, 0))),
    **dict.fromkeys(("lap", "laps", "rev", "revs", "cycles"), ("1", (0, 0, 0, 0, 0, 1))),
    "rpm": ("1/60", (0, 0, -1, 0, 0, 0)),
    "in": ("0.0254", (1, 0, 0, 0, 0, 0)),
    "ft": ("0.3048", (1, 0, 0, 0, 0, 0)),
    "lb": ("0.45359237", (0, 1, 0, 0, 0, 0)),
    "lbf": ("4.4482216152605", (1, 1, -2, 0, 0, 0)),
    "psi": ("44482216152605/6451600000", (-1, 1, -2, 0, 0, 0)),
    "ksi": ("44482216152605/6451600", (-1, 1, -2, 0, 0, 0)),
    "kgf": ("9.80665", (1, 1, -2, 0, 0, 0)),
    **dict.fromkeys(("HV", "HB", "HBW"), ("9806650", (-1, 1, -2, 0, 0, 0))),
}
"""Symbols without prefixes. Vickers and Brinell hardness are in kgf/mm² (ISO 6507-1, 6506-1)."""
PREFIXES = {"p": -12, "n": -9, "u": -6, "m": -3, "c": -2, "k": 3, "M": 6, "G": 9, "T": 12}
"""Prefixes of a unit, each with its power of ten."""
_FACTOR = re.compile(r"(1|[A-Za-z]+)(?:\^?(-?[1-9]))?")
_VICKERS_WITH_LOAD = re.compile(r"\bHV\d+(?:\.\d+)?\b")
_ROCKWELL = re.compile(r"HR[A-Z]?")
_RAISED = re.compile("[⁺⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+")
_PLAIN_SIGNS = str.maketrans("µμ⋅−⁺⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "uu·-+-0123456789")

_CELSIUS = ("degC", "°C")
_ZERO_CELSIUS = Fraction("273.15")

_KINDS = {
    "1": ("a plain number", "0.3"),
    "m": ("a length", "5 mm"),
    "m^2": ("an area", "1 mm^2"),
    "m^3": ("a volume", "1 mm^3"),
    "kg": ("a mass", "2 g"),
    "s": ("a time", "1 h"),
    "K": ("a temperature", "90 degC"),
    "lap": ("a number of laps", "500 laps"),
    "Hz": ("a frequency", "25 Hz"),
    "m/s": ("a speed", "0.1 m/s"),
    "N": ("a force", "100 N"),
    "Pa": ("a pressure", "2 GPa"),
    "1/Pa": ("an inverse pressure", "1e-6 mm^3/(N m)"),
    "Pa s": ("a dynamic viscosity", "80 mPa s"),
    "m^2/s": ("a kinematic viscosity", "100 mm^2/s"),
    "Pa/m": ("a foundation modulus", "20 GPa/mm"),
    "J": ("an energy", "1 J"),
    "W": ("a power", "1 W"),
    "J/mol": ("an energy per mole", "50 kJ/mol"),
    "J/m^2": ("an energy per area", "1 kJ/m^2"),
    "kg/m^3": ("a density", "7850 kg/m^3"),
    "W/(m K)": ("a thermal conductivity", "46 W/(m K)"),
    "J/(kg K)": ("a heat capacity", "460 J/(kg K)"),
}
"""Name and example of a quantity, by its SI unit."""

_BOUNDS = {
    "above": ("greater than", operator.gt),
    "at_least": ("at least", operator.ge),
    "below": ("less than", operator.lt),
    "at_most": ("at most", operator.le),
}
"""Bounds of a `Quantity`: words and comparison."""

_PREFIXED = re.compile(r"(m|N|Pa|Hz|W|J)(?!\^|\w)")
"""Start of a unit that is written with prefixes."""
_THOUSANDS = {1.0: ""} | {
    10.0**power: prefix.replace("u", "µ") for prefix, power in PREFIXES.items() if power % 3 == 0
}
"""Prefixes in steps of a thousand, by their factor."""

_LONGEST = 100
_TIMES_TEN = re.compile(r"^10\^|(?<=[\d.])\s*[·*×x]\s*10\^")
_NUMBER = re.compile(
    r"([+-]?(?:\d+/0*[1-9]\d*|(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3}(?!\d))?))(?![\d.,])(.*)",
    re.S | re.A,
)


def plain(text: str) -> str:
    """Return text with one sign for each meaning: ``u`` for ``µ``, ``^3`` for ``³`` and ``**3``."""
    raised = _RAISED.sub(lambda digits: f"^{digits[0]}", text.replace("**", "^"))
    return raised.translate(_PLAIN_SIGNS)


@cache
def scale(unit: str) -> tuple[Fraction, Dimension]:
    """Return the size in SI and the dimension of a unit such as ``mm^3/(N m)``.

    A product without spaces, as ``N.m``, ``N·m`` or ``Nm``, binds closer than the slash, and a
    prefix belongs to its first symbol. The test load of a Vickers hardness, as in ``HV30``, is
    ignored; ValueError if it cannot be read.
    """
    text = plain(_VICKERS_WITH_LOAD.sub("HV", unit))
    size, dimension = Fraction(1), (0, 0, 0, 0, 0, 0)
    for place, part in enumerate(map(str.strip, text.split("/"))):
        inside = part[1:-1] if part.startswith("(") and part.endswith(")") else part
        factors = re.split(r"\s*\*\s*|\s+[.·]\s+|\s+", inside.strip())
        if place and inside == part and len(factors) > 1:
            raise ValueError("put the divisor in parentheses, as in 'mm^3/(N m)'")
        for factor in re.split("[.·]", "·".join(factors)):
            base, of, exponent = _power(factor)
            exponent = -exponent if place else exponent
            size *= base**exponent
            m, kg, s, k, mol, lap = (d + exponent * o for d, o in zip(dimension, of, strict=True))
            dimension = m, kg, s, k, mol, lap
    return size, dimension


def _power(factor: str) -> tuple[Fraction, Dimension, int]:
    """Return size and dimension of a symbol, and its exponent."""
    match = _FACTOR.fullmatch(factor)
    if match is None or (match[1] == "1" and match[2]):
        raise ValueError(f"cannot read the unit {factor!r}" if factor else "a unit is missing")
    name, exponent = match[1], int(match[2] or 1)
    if known := _SYMBOLS.get(name) or _UNPREFIXED.get(name):
        return Fraction(known[0]), known[1], exponent
    if name[0] in PREFIXES and name[1:] in _SYMBOLS:
        size, dimension = _SYMBOLS[name[1:]]
        return Fraction(size) * Fraction(10) ** PREFIXES[name[0]], dimension, exponent
    if name == "degC":
        raise ValueError("degC has an offset; use K in a compound unit")
    if _ROCKWELL.fullmatch(name):
        raise ValueError("Rockwell hardness has no fixed conversion; give GPa or HV (Vickers)")
    raise ValueError(f"unknown unit {name!r}")


def parse(text: str, unit: str, hint: str = "") -> float:
    """Return a text such as ``"5 mm"`` or ``"2·10⁻⁷ mm³/Nm"`` in an SI unit, rounded once.

    `CaseError`, which ends in `hint`, if it cannot be read, or has another dimension than `unit`,
    which is ``"1"`` for none.
    """
    hint = hint or _needed(unit, _example(unit))
    written = _TIMES_TEN.sub(lambda ten: "e" if ten.start() else "1e", plain(text.strip()))
    match = _NUMBER.fullmatch(written) if len(text) <= _LONGEST else None
    if match is None:
        raise CaseError(f"{text[:_LONGEST]!r} is not a quantity; {hint}")
    number, symbols = Fraction(match[1]), match[2].strip()
    zero = _ZERO_CELSIUS if symbols in _CELSIUS else 0
    try:
        factor, dimension = scale("K" if zero else symbols or "1")
    except ValueError as error:
        like = did_you_mean(symbols, _units(unit))
        meant = f" (did you mean {like!r}?)" if like else ""
        raise CaseError(f"{text!r}: {error}{meant}; {hint}") from None
    if dimension != scale(unit)[1]:
        given = f"is {_called(dimension)}" if symbols else "has no unit"
        raise CaseError(f"{text!r} {given}; {hint}")
    try:
        return float(number * factor + zero)
    except OverflowError:
        raise CaseError(f"{text!r} is not finite; {hint}") from None


def stated(value: float, unit: str) -> str:
    """Return a value in an SI unit as text with all its digits: ``"2 TPa"``, not 2e+12 Pa."""
    prefixes = _THOUSANDS if value and _PREFIXED.match(unit) else {1.0: ""}
    factor = max((f for f in prefixes if f <= abs(value) * (1 + ROUND_OFF)), default=min(prefixes))
    # What the division rounds stands in the sixteenth digit.
    number = f"{value / factor:.15g}"
    return number if unit == "1" else f"{number} {prefixes[factor]}{unit}"


@dataclass(frozen=True)
class Quantity:
    """Marks a float as a quantity that may be written with a unit.

    Used as ``Annotated[float, Quantity("Pa", above=0)]``: the field takes a
    number, in `unit`, or text such as ``"4 GPa"``, and holds a float in `unit`.

    Parameters
    ----------
    unit : str
        The SI unit of the value; ``"1"`` for none.
    above, at_least, below, at_most : float, optional
        Bounds, in `unit`.
    usual : tuple of float, optional
        Range, in `unit`. A value beyond it, other than 0, is allowed, but
        `tribo check` and the message of a failed run warn about it.
    remedy : str, optional
        The fix for a value out of bounds, for its message.
    also : tuple of str, optional
        Units of other quantities that a motion converts to this one, such as ``"lap"`` for a
        length. Text in them is checked and left as text; for a number, laps are the number.

    Examples
    --------
    >>> stroke = tribo.Quantity("m", above=0, usual=(1e-6, 1.0))
    >>> stroke.read("5 mm")
    0.005
    >>> stroke.doubt(5.0)
    "5 m, usual are 1 µm to 1 m, written as in '5 mm': is the unit wrong or missing?"
    """

    unit: str
    above: float | None = None
    at_least: float | None = None
    below: float | None = None
    at_most: float | None = None
    usual: tuple[float, float] | None = None
    remedy: str | None = None
    also: tuple[str, ...] = ()

    def hint(self, info: object = None) -> str:
        """Return the end of a message, as "a length [m] is needed, as in '5 mm'"."""
        return _needed(self.unit, self.example)

    @property
    def example(self) -> str:
        """A value that it takes, as text: its unit's, or else the middle of its range."""
        text = _example(self.unit)
        low, high = self.usual or (self.at_least or self.above, self.at_most or self.below)
        low, high = low or 0.0, high or math.inf
        if low <= parse(text, self.unit) <= high:
            return text
        middle = high / 2 if low <= 0 else 2 * low if high == math.inf else math.sqrt(low * high)
        return stated(float(f"{middle:.1e}"), self.unit)

    def read(self, value: object) -> float:
        """Return `value` in SI.

        Raises
        ------
        CaseError
            If `value` is not such a quantity or is out of bounds.
        """
        if isinstance(value, str):
            number, given = parse(value, self.unit, self.hint()), value.strip()
        elif isinstance(value, Real) and not isinstance(value, bool):
            try:
                number = float(value)
            except OverflowError:
                number = math.inf
            given = f"{number:g}" if self.unit == "1" else f"{number:g} {self.unit}"
        else:
            raise CaseError(f"{shown(value)} is not a quantity; {self.hint()}")
        if not math.isfinite(number):
            raise CaseError(f"{given} is not finite; {self.hint()}")
        bounds = [(getattr(self, field), *how) for field, how in _BOUNDS.items()]
        bounds = [each for each in bounds if each[0] is not None]
        if not all(holds(number, bound) for bound, _, holds in bounds):
            zero = "0 K" if self.unit == "K" else "0"
            must = " and ".join(
                f"{words} {stated(bound, self.unit) if bound else zero}"
                for bound, words, _ in bounds
            )
            remedy = f"; {self.remedy}" if self.remedy else f", as in '{self.example}'"
            raise CaseError(f"{given}: must be {must}{remedy}")
        return number

    def doubt(self, value: float) -> str | None:
        """Return a question about `value` (in `unit`) if it is out of the usual range."""
        if self.usual is None or value == 0 or self.usual[0] <= value <= self.usual[1]:
            return None
        given, low, high = (stated(each, self.unit) for each in (value, *self.usual))
        written = f", written as in '{self.example}': is the unit wrong or missing?"
        asked = ": is that meant?" if self.unit == "1" else written
        return f"{given}, usual are {low} to {high}{asked}"

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        """Return how pydantic validates the field."""
        scale(self.unit)
        return core_schema.no_info_plain_validator_function(
            self._validate,
            serialization=core_schema.plain_serializer_function_ser_schema(
                lambda value: value if isinstance(value, str) else float(value)
            ),
        )

    def _validate(self, value: object) -> float | str:
        try:
            for unit in self.also:
                if isinstance(value, str) and is_in(unit, value):
                    number = replace(self, unit=unit, also=()).read(value)
                    return number if self.unit == "1" else value.strip()
            return self.read(value)
        except CaseError as error:
            raise PydanticCustomError("quantity", "{message}", {"message": str(error)}) from None


def is_in(unit: str, text: str) -> bool:
    """Whether a text can be read in an SI unit."""
    try:
        parse(text, unit)
    except CaseError:
        return False
    return True


def quantities(annotation: Any) -> Iterator[Quantity]:
    """Yield the quantities among the `parts` of a field or an annotation."""
    return (part for part in parts(annotation) if isinstance(part, Quantity))


def parts(annotation: Any) -> Iterator[Any]:
    """Yield a field or an annotation, and every type and mark inside."""
    yield annotation
    field = isinstance(annotation, FieldInfo)
    for part in (annotation.annotation, *annotation.metadata) if field else get_args(annotation):
        yield from parts(part)


def each_in(annotation: Any, count: int) -> list[Any]:
    """Return the annotation of each value of a sequence."""
    for part in parts(annotation):
        inner = [a for a in get_args(part) if a is not Ellipsis]
        if get_origin(part) in (list, tuple) and len(inner) in (1, count):
            return inner * (count // len(inner))
    return [annotation] * count


def _called(dimension: Dimension) -> str:
    for unit, (name, _) in _KINDS.items():
        if scale(unit)[1] == dimension:
            return name if unit == "1" else f"{name} [{unit}]"
    powers = zip(("m", "kg", "s", "K", "mol", "lap"), dimension, strict=True)
    return "a quantity in " + " ".join(f"{u}^{n}" if n != 1 else u for u, n in powers if n)


def _units(unit: str) -> list[str]:
    """Return a unit and the symbols with its dimension, nearest in size to its example first."""
    every = [*_SYMBOLS, *_UNPREFIXED, *(p + symbol for p in PREFIXES for symbol in _SYMBOLS), unit]
    of_kind = (each for each in every if scale(each)[1] == scale(unit)[1])
    usual = parse(_example(unit), unit)
    return sorted(of_kind, key=lambda each: abs(math.log(scale(each)[0] / usual)))


def _example(unit: str) -> str:
    return _KINDS[unit][1] if unit in _KINDS else f"1 {unit}"


def _needed(unit: str, example: str) -> str:
    return f"{_called(scale(unit)[1])} is needed, as in '{example}'"
