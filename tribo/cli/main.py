"""The `tribo` command: its subcommands, each imported only when called."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, NoReturn

import click

from tribo.cli.commands import OWN, imported, offered, refused
from tribo.cli.streams import STDERR, STDOUT, over, say
from tribo.core.errors import CaseError, Interrupted, ReaderGone, TriboError, TriboWarning
from tribo.core.words import did_you_mean, suggestion
from tribo.packages import COMMANDS, how_to_install


class LazyGroup(click.Group):
    """A group that imports a subcommand's module only when it is called."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the commands in the order a user meets them."""
        return list(offered())

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command:
        """Import the command's module, and return the command in it."""
        if cmd_name in OWN:
            return imported(OWN[cmd_name])
        if cmd_name in offered():
            return imported(offered()[cmd_name])
        if cmd_name in COMMANDS:
            package, _ = COMMANDS[cmd_name]
            what = "; ".join(refused(package)) or how_to_install(package)
            raise CaseError(f"'tribo {cmd_name}' comes with {package}: {what}")
        near = suggestion(did_you_mean(cmd_name, [*offered(), *COMMANDS]))
        what = " ".join([f"No such command {cmd_name!r}{near}", *refused()])
        raise click.UsageError(what, ctx)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """List the commands without importing any."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, command.summary) for name, command in offered().items()])
        absent = [
            (name, f"{summary} {how_to_install(package)}")
            for name, (package, summary) in COMMANDS.items()
            if name not in offered()
        ]
        if absent:
            with formatter.section("Not installed"):
                formatter.write_dl(absent)


@click.group(cls=LazyGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="tribo")
def tribo() -> None:
    """Simulate wear: contact mechanics, wear laws and kinematics as plugins.

    \b
    Example:
      tribo demo
      tribo new ball_on_disk my.toml
      tribo check my.toml
      tribo run my.toml

    Exit codes: 0 done, 2 bad input, 3 numerical failure, a failing plugin or
    output that cannot be written, as to a closed standard output, 130
    interrupted, 141 the reader of a pipe has gone.
    """


@contextmanager
def _warnings_on_stderr() -> Iterator[None]:
    """Print tribo's own warnings as one line each, and no others."""

    def show(message: Warning | str, category: type[Warning], *_: Any, **__: Any) -> None:
        if issubclass(category, TriboWarning):
            say("warning", "yellow", str(message))

    with warnings.catch_warnings():
        warnings.simplefilter("always", TriboWarning)
        warnings.showwarning = show
        yield


def main() -> None:
    """Run the command; every expected error becomes one message and an exit code."""
    # pydantic fails on any malformed distribution while it looks for its own plugins.
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    sys.stdout, sys.stderr = over(sys.stdout, STDOUT), over(sys.stderr, STDERR)
    try:
        with _warnings_on_stderr():
            tribo.main(standalone_mode=False)
            # What a plugin may have printed.
            print(end="", flush=True)
    except click.exceptions.Abort as error:
        stopped = error.__cause__
        message = str(stopped) if isinstance(stopped, Interrupted) else "interrupted"
        _fail(message, Interrupted.exit_code)
    except click.ClickException as error:
        error.show()
        sys.exit(error.exit_code)
    except ReaderGone as error:
        # A reader such as `head` has seen enough, which is no mistake.
        sys.exit(error.exit_code)
    except Exception as error:
        if os.environ.get("TRIBO_DEBUG"):
            raise
        _fail(*_told(error))


def _told(error: Exception) -> tuple[str, int]:
    if isinstance(error, TriboError):
        return "\n".join([str(error), *getattr(error, "__notes__", ())]), error.exit_code
    if isinstance(error, RecursionError):
        return "tables or lists are nested too deeply", CaseError.exit_code
    if isinstance(error, MemoryError):
        return "out of memory; lower grid.cells, or raise the limit of this process", 3
    return (
        f"internal error: {type(error).__name__}: {error}\n"
        "This is a fault in tribo or in a plugin; TRIBO_DEBUG=1 shows where."
    ), 1


def _fail(message: str, code: int) -> NoReturn:
    say("error", "red", message)
    sys.exit(code)
