"""Files that hold what a command printed."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from tribo import CaseError


@contextmanager
def printed_by(command: str, path: Path, option: str = "") -> Iterator[None]:
    """Turn errors of reading what a command printed into a `CaseError` that names the file.

    `option` is the option of the command line that gave the file.
    """
    try:
        yield
    except FileNotFoundError:
        raise CaseError(f"{path}: there is no such file", option) from None
    except (OSError, ValueError, LookupError, TypeError, AttributeError) as error:
        raise CaseError(f"{path} is not what {command!r} prints: {error}", option) from error
