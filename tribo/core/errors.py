"""Exceptions of tribo, with the exit codes of the command line."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, ClassVar


class TriboError(Exception):
    """Base of every error tribo raises on purpose.

    The message is one clear statement for a user: what was given, what is
    allowed, what to do.

    Examples
    --------
    >>> try:
    ...     tribo.Material(young="210 mm", poisson=0.3)
    ... except tribo.TriboError as error:
    ...     print(error)
    young: '210 mm' is a length [m]; a pressure [Pa] is needed, as in '2 GPa'
    """

    exit_code: ClassVar[int] = 1


class CaseError(TriboError):
    """The input is wrong: a case, an option or a file.

    Parameters
    ----------
    message : str
        What was given, what is allowed and what to do.
    path : str, optional
        Where in the case, as ``bodies.ball.material.young``.

    Examples
    --------
    >>> error = tribo.CaseError("the ball is softer than the disk", "bodies.ball.material")
    >>> print(error)
    bodies.ball.material: the ball is softer than the disk
    """

    exit_code: ClassVar[int] = 2

    def __init__(self, message: str, path: str = "") -> None:
        super().__init__(f"{path}: {message}" if path else message)
        self.path = path


class WrongValues(CaseError, ValueError):
    """A table was given wrong values in Python."""


class NumericalError(TriboError):
    """A solve or a step could not be carried out to its tolerance.

    Examples
    --------
    >>> tribo.NumericalError.exit_code  # of `tribo run`
    3
    """

    exit_code: ClassVar[int] = 3


class OutOfWindow(NumericalError):
    """A contact reached the edge of the window."""


class TooWorn(OutOfWindow):
    """A body has lost more than its shape and the window hold; `finding` states where and when."""

    finding: Any = None


class PluginError(NumericalError):
    """A component raised an unexpected error.

    Examples
    --------
    >>> issubclass(tribo.PluginError, tribo.NumericalError)  # one clause catches both
    True
    """


class BadValues(PluginError):
    """A component answered with values that break its contract.

    In the middle of a step, a shorter step may avoid them; at an accepted state
    they are an error.
    """


class OutputError(TriboError):
    """A file, or standard output, could not be written.

    Examples
    --------
    >>> tribo.OutputError.exit_code  # of a command whose disk is full
    3
    """

    exit_code: ClassVar[int] = 3


class Interrupted(KeyboardInterrupt):
    """The run was stopped from outside and can be resumed.

    Like Ctrl-C, it passes through code that handles errors.

    Examples
    --------
    >>> issubclass(tribo.Interrupted, Exception), tribo.Interrupted.exit_code
    (False, 130)
    """

    exit_code: ClassVar[int] = 130


class ReaderGone(TriboError):
    """Standard output is a pipe that was closed, as by `head`; no message is printed."""

    exit_code: ClassVar[int] = 141


class TriboWarning(UserWarning):
    """A warning for the user of a run that does not stop.

    Examples
    --------
    >>> import warnings
    >>> coarse = ["grid.cells=16", "contact.type=winkler", "stop.depth=1 um"]
    >>> with warnings.catch_warnings(record=True, category=tribo.TriboWarning) as caught:
    ...     warnings.simplefilter("always")
    ...     result = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse).run()
    >>> str(caught[0].message).partition(",")[0]
    'resolution: the contact is only 2 cells wide'
    """


_INSIDE = ("tribo", "pydantic", "pluggy")
"""Packages, by the start of their names, whose lines no warning points to."""


def warn(words: str, category: type[Warning] = TriboWarning) -> None:
    """Warn at the line of whoever called tribo or one of its packages."""
    frame, level = sys._getframe(1), 2
    while frame.f_back and frame.f_globals.get("__name__", "").startswith(_INSIDE):
        frame, level = frame.f_back, level + 1
    warnings.warn(words, category, stacklevel=level)


@contextmanager
def about(name: str) -> Iterator[None]:
    """Put the name of what failed before the words of an error raised inside."""
    try:
        yield
    except (TriboError, Interrupted) as error:
        raise type(error)(f"{name}: {error}") from error


@contextmanager
def located(path: str) -> Iterator[None]:
    """Add its place in the case to a `CaseError` raised inside that has none."""
    try:
        yield
    except CaseError as error:
        if error.path:
            raise
        raise CaseError(str(error), path) from error
