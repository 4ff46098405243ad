"""`tribo report`."""

from __future__ import annotations

from pathlib import Path

import click

from tribo.cli.options import PATH, RESULT


@click.command()
@RESULT
@click.option("-o", "--output", "page", type=PATH, help="The file; OUTPUT-report.html.")
@click.option(
    "--verified", type=PATH, help="What 'tribo verify CASE --json' printed, for uncertainties."
)
def report(output: Path, page: Path | None, verified: Path | None) -> None:
    """Write a report of the result OUTPUT to hand on: one HTML file that opens offline.

    It has the answer in a sentence, the tables, the case, maps and sections at every
    saved time, the worn surface in 3-D, the history, and what made it. It needs the extra
    'report': pip install "tribo[report]".

    \b
    Example:
      tribo report my.h5
      tribo report my.h5 -o report.html --verified study.json
    """
    from tribo.report.write import write_report

    path = page or output.with_name(f"{output.stem}-report.html")
    write_report(output, path, verified=verified)
    click.echo(f"Wrote {path} ({path.stat().st_size / 1e6:.1f} MB), for any browser, offline")
