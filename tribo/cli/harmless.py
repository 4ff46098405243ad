"""Text from a file reaches the terminal without its control characters."""

from __future__ import annotations

import re

import click

_CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069]")
"""All but tab and line feed; and what turns the direction of writing."""


def harmless(text: str) -> str:
    """Return `text` with control characters as escapes, as in a Python string."""
    return _CONTROL.sub(lambda match: match[0].encode("unicode_escape").decode(), text)


def echo(text: str, *, err: bool = False) -> None:
    """Print a line, on standard error if that is asked for."""
    click.echo(harmless(text), err=err)
