"""Size in SI and dimension of a unit."""

from __future__ import annotations

import re
from fractions import Fraction
from functools import cache

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
