"""Plain signs on a stream that cannot carry µ, ³ and their like."""

from __future__ import annotations

import codecs
import io
from typing import TextIO

HANDLER = "tribo.plain"
SIGNS = {
    "µ": "u",
    "μ": "u",
    "²": "^2",
    "³": "^3",
    "·": "*",
    "×": "x",
    "–": "-",
    "−": "-",
    "…": "...",
    "°": "deg",
}


def make_plain(stream: TextIO) -> None:
    """Let `stream` write what its encoding lacks in plain signs, instead of failing."""
    codecs.register_error(HANDLER, _plain)
    if isinstance(stream, io.TextIOWrapper):
        stream.reconfigure(errors=HANDLER)


def _plain(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    lost = error.object[error.start : error.end]
    return "".join(SIGNS.get(sign, "?") for sign in lost), error.end
