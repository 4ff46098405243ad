"""Arguments and options that several commands take."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import click

PATH = click.Path(path_type=Path)
CASE = click.argument("case", type=PATH)
RESULT = click.argument("output", type=PATH)
SET = click.option(
    "--set", "overrides", multiple=True, metavar="PATH=VALUE", help="Change a value."
)
PLUGIN = click.option(
    "--plugin",
    multiple=True,
    type=PATH,
    metavar="FILE",
    expose_value=False,
    callback=lambda _, __, files: _add(files),
    help="Run a Python file, and let its classes and hooks take part.",
)
JSON = click.option("--json", "as_json", is_flag=True, help="Print a JSON object, in SI units.")


def _add(files: tuple[Path, ...]) -> None:
    if files:
        from tribo.registry.plugin_file import add_files

        add_files(files)


def echo_json(data: Any) -> None:
    """Print plain data as JSON; a number that is not finite, which JSON lacks, is null."""
    click.echo(json.dumps(_finite(data), indent=2, allow_nan=False))


def _finite(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _finite(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
