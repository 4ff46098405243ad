"""Values and names in messages."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from pathlib import Path

_LONGEST = 60
"""Characters of a value, of the 80 of a line; the message has the rest."""


def shown(value: object) -> str:
    """Return `value` as a short text for a message, in the words of a case file."""
    if value is None:
        return "nothing"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, Mapping):
        return "a table"
    if isinstance(value, list | tuple):
        return "a list"
    text = repr(value)
    return text if len(text) <= _LONGEST else text[: _LONGEST - 1] + "…"


def signed(value: float, decimals: int) -> str:
    """Return a number with its sign; without one if it rounds to 0."""
    text = f"{value:+z.{decimals}f}"
    return text if float(text) else text[1:]


def digits_of(lower: float, upper: float) -> int:
    """Return the digits of an interval's ends that show its half-width to two digits; 3 or more."""
    if not 0 < upper - lower < math.inf:
        return 3
    return max(3, 2 + math.floor(math.log10(upper)) - math.floor(math.log10((upper - lower) / 2)))


def plus_minus(value: float, uncertainty: float) -> tuple[str, str]:
    """Return a value and its uncertainty, which has two digits, with as many decimals.

    An uncertainty below a millionth of the value leaves the value six digits.
    """
    if not uncertainty > 1e-6 * abs(value):
        return f"{value:.6g}", f"{uncertainty:.1g}"
    decimals = max(1 - math.floor(math.log10(uncertainty)), 0)
    return f"{value:.{decimals}f}", f"{uncertainty:.{decimals}f}"


def readable(value: float, form: str) -> str:
    """Return a number in a format, with two digits where that would round a twentieth of it off.

    Below a million it is written out.
    """
    text = f"{value:{form}}"
    text = text if abs(float(text) - value) <= 0.05 * abs(value) else f"{value:.2g}"
    return f"{float(text):g}" if "e+" in text else text


def checked_name(name: str) -> str:
    """Return the name of a body, after which files are called; ValueError if it is no such name."""
    if not name.replace("_", "").replace("-", "").isalnum():
        raise ValueError(f"{name!r} is no good as a body's name; use letters, digits, - and _")
    return name


def did_you_mean(name: object, known: Iterable[str]) -> str | None:
    """Return the name in `known` that is most like `name`, if one is.

    The first that is the same but for capitals and a prefix, as ``Hz`` for ``hz``, comes before the
    nearly same.
    """
    if not isinstance(name, str):
        return None
    every, end = list(known), f".{name}".casefold()
    same = [each for each in every if f".{each}".casefold().endswith(end)]
    return next(iter(same or get_close_matches(name, every, n=1)), None)


def similar_file(path: Path, suffix: str, otherwise: str) -> str:
    """Return the remedy for a missing file: one beside it with a similar name, or `otherwise`."""
    like = did_you_mean(path.stem, (each.stem for each in path.parent.glob(f"*{suffix}")))
    return f"did you mean {like}{suffix}?" if like else otherwise


def suggestion(meant: str | None) -> str:
    """Return the end of a sentence, with a suggestion if there is one."""
    return f"; did you mean {meant!r}?" if meant else "."


def unknown(what: str, name: str, known: Iterable[str]) -> str:
    """Return a message that a name is unknown, with the known names."""
    names = list(known)
    meant = suggestion(did_you_mean(name, names))
    return f"there is no {what} {name!r}{meant} There are {', '.join(names) or 'none'}"


def said(error: BaseException) -> str:
    """Return the type of an error and its message on one line."""
    try:
        text = " ".join(str(error).split())
    except Exception:
        text = "(its message cannot be shown)"
    if isinstance(error, SyntaxError):
        text = error.msg
    return f"{type(error).__name__}: {text}" if text else f"{type(error).__name__} and says no more"
