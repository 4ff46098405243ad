"""`tribo sweep`."""

from __future__ import annotations

from pathlib import Path

import click

from tribo.cli.options import CASE, JSON, PATH, PLUGIN, SET, echo_json
from tribo.core.errors import NumericalError


@click.command()
@CASE
@click.option("--vary", multiple=True, required=True, metavar="PATH=A,B", help="Vary a value.")
@SET
@click.option("-o", "--output", type=PATH, help="Write to this folder, by default CASE-sweep.")
@click.option(
    "-j",
    "--jobs",
    type=click.IntRange(1),
    help="Run this many cases at once, by default one a core.",
)
@JSON
@PLUGIN
def sweep(
    case: Path,
    vary: tuple[str, ...],
    overrides: tuple[str, ...],
    output: Path | None,
    jobs: int | None,
    as_json: bool,
) -> None:
    """Run variants of CASE in parallel.

    Any of its values can vary, as with 'tribo compare'; several --vary multiply.
    Every case is validated before any is run. Afterwards the folder holds
    runs.csv (a row a run), the folder results and, where curves say it, a picture
    of the depth of each worn body. A failing run is recorded and the others
    continue. A sweep that was stopped, has failed runs or has more values now
    continues with the same command.

    \b
    Example:
      tribo sweep my.toml --vary load.normal='20 N,50 N' --vary grid.cells=64,128

    Exit codes: 0 all done, 2 bad input, 3 runs have failed, 130 interrupted.
    """
    from tribo.config.load import read_toml
    from tribo.config.overrides import apply_settings
    from tribo.observers.progress import progress_bar
    from tribo.study.sweeping.sweep import sweep as run
    from tribo.study.variation import read_axes

    tables, axes = apply_settings(read_toml(case), overrides), read_axes(vary)
    folder = output or case.parent / f"{case.stem}-sweep"
    with progress_bar() as bar:
        shown = bar.add_task("", total=None)

        def tell(total: int, done: int, failed: int) -> None:
            ended, failures = done + failed, f", {failed} failed" if failed else ""
            words = f"{ended} of {total} runs{failures}"
            bar.update(shown, total=total, completed=ended, description=words)
            if bar.disable:
                click.echo(words, err=True)

        swept = run(tables, axes, folder, jobs=jobs, tell=tell)
    total, reasons = len(swept.runs), swept.failures()
    failed = sum(map(len, reasons.values()))
    if as_json:
        echo_json(swept.as_json())
    else:
        from tribo.cli.console import Console
        from tribo.study.sweeping.summary import draw_runs, measured, runs_table

        Console().table(runs_table(swept.table, measured(swept.table)))
        warned = sum(swept.table.query("status == 'done'")["message"] != "")
        told = f", {warned} with warnings: see the column message of runs.csv" if warned else ""
        click.echo(f"{total - failed} of {total} runs are done{told}.")
        click.echo(f"Wrote {swept.folder / 'runs.csv'}")
        for path in draw_runs(swept.table, swept.folder):
            click.echo(f"Wrote {path}")
    if failed:
        lines = [f"{failed} of {total} runs failed; the same command repeats them:"]
        for message, (first, *others) in reasons.items():
            more = f" and {len(others)} more" if others else ""
            lines.append(f"  run {first.number} ({first.label}){more}: {message}")
        raise NumericalError("\n".join(lines))
