"""`tribo report`."""

from __future__ import annotations

from pathlib import Path

import click
from tribo import CaseError
from tribo.kernel_api import PATH


@click.command()
@click.argument("what", nargs=-1, required=True, type=PATH)
@click.option("-o", "--output", type=PATH, help="Write this file, by default WHAT-report.html.")
@click.option(
    "--verified",
    type=PATH,
    help="Take uncertainties from this output of 'tribo verify CASE --json'.",
)
def report(what: tuple[Path, ...], output: Path | None, verified: Path | None) -> None:
    """Write a report of WHAT to hand on: one HTML file that opens offline in any browser.

    WHAT is a result, or the folder of a sweep, or what 'tribo calibrate --json' printed;
    several results, or the folder of 'tribo compare', are set side by side. The report has
    the answer in a sentence, tables, the case, maps and sections at every saved time, the
    worn surface in 3-D, the history, and what made it.

    \b
    Example:
      tribo report my.h5
      tribo report my.h5 -o report.html --verified study.json
      tribo report a.h5 b.h5
      tribo report my-sweep
      tribo report fit.json
    """
    from tribo.kernel_api import readable

    from tribo_report.write import write_report

    path = output or what[0].parent / "-".join([*(each.stem for each in what), "report.html"])
    if path.suffix.lower() not in (".html", ".htm"):
        raise CaseError(f"{path} is no HTML file; end its name in .html", "--output")
    write_report(what[0] if len(what) == 1 else what, path, verified=verified)
    click.echo(
        f"Wrote {path} ({readable(path.stat().st_size / 1e6, '.1f')} MB), for any browser, offline"
    )
