"""`tribo compare`."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import click

from tribo.cli.options import JSON, PATH, PLUGIN, SET, echo_json
from tribo.core.errors import CaseError, located

if TYPE_CHECKING:
    from tribo.study.comparison import Comparison


@click.command()
@click.argument("files", nargs=-1, required=True, type=PATH)
@click.option("--vary", multiple=True, metavar="PATH=A,B", help="Vary a value.")
@SET
@PLUGIN
@click.option("-o", "--output", type=PATH, help="Write to this folder, by default CASE-compare.")
@click.option("--at", "at", multiple=True, metavar="TIME", help="Show this saved time, as '1 h'.")
@JSON
@click.option("--no-plots", is_flag=True, help="Write no pictures.")
def compare(
    files: tuple[Path, ...],
    vary: tuple[str, ...],
    overrides: tuple[str, ...],
    output: Path | None,
    at: tuple[str, ...],
    as_json: bool,
    no_plots: bool,
) -> None:
    """Run variants of a case, or take FILES, results and cases, and set them side by side.

    With --vary FILES is one case. Any of its values can vary: commas stand
    between what takes turns, or it is a TOML list in brackets. Several --vary
    multiply. X.type=A,B replaces the table X by the defaults of each type that is
    not the case's own. What is done already in the folder is not run again. The
    first variant or file is what the others are compared with.

    \b
    Example:
      tribo compare my.toml --vary contact.type=dcfft,winkler
      tribo compare my.toml --vary load.normal='50 N,100 N' --vary grid.cells=64,128 -o grids
      tribo compare a.h5 b.h5 --at 0 --at '10 min'
    """
    from tribo.config.load import read_toml
    from tribo.config.overrides import apply_settings, parse_value
    from tribo.core.units import Quantity
    from tribo.study.comparison import compare as run
    from tribo.study.variation import read_axes

    stems = dict.fromkeys(path.stem for path in files)
    folder = output or files[0].parent / "-".join([*stems, "compare"])
    with located("--at"):
        times = [Quantity("s", at_least=0).read(parse_value(text)) for text in at]
    if vary and len(files) > 1:
        raise CaseError(f"--vary varies one case, {len(files)} files are given")
    if overrides and not vary:
        raise CaseError("--set is for a case that varies, with --vary")
    what = apply_settings(read_toml(files[0]), overrides) if vary else files
    with run(what, read_axes(vary), folder, progress=bool(vary)) as comparison:
        chosen = comparison.chosen_times(times)
        if not as_json:
            print_comparison(comparison, chosen)
        pictures = []
        if not no_plots:
            from tribo.plotting.figures import write_figures

            named = {f"comparison_{t:g}s": partial(comparison.picture, t) for t in chosen}
            pictures = write_figures(named, folder)
        if as_json:
            echo_json(comparison.as_json(times) | {"pictures": [str(path) for path in pictures]})
            return
    for path in pictures:
        click.echo(f"Wrote {path}")


def print_comparison(comparison: Comparison, times: Sequence[float]) -> None:
    """Print what differs at `times`, the results side by side."""
    from rich.markup import escape

    from tribo.cli.console import Console
    from tribo.study.side_by_side import comparison_table

    console = Console()
    if varied := comparison.varied:
        console.print(f"Varied: {', '.join(varied)}")
    console.print(
        f"Percentages are relative to {escape(comparison.reference)}. Maps are compared in its "
        "cells: the L2 norm of the difference, then the largest, which for a pressure often lies "
        "in a cell at the rim."
    )
    console.table(comparison_table(comparison, times))
    for each in comparison.findings:
        console.print(f"[yellow]Note:[/] {escape(each.words)}")
