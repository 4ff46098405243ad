"""`tribo resume`."""

from __future__ import annotations

from pathlib import Path

import click

from tribo.cli.options import PLUGIN, RESULT


@click.command()
@RESULT
@PLUGIN
@click.option("--allow-changed", is_flag=True, help="Accept changed components.")
def resume(output: Path, allow_changed: bool) -> None:
    """Continue the stopped run whose result file is OUTPUT.

    The result has the same bits as the result of a run that was never stopped. A run that is done
    stays as it is.

    \b
    Example:
      tribo resume my.h5

    Exit codes: 0 done, 2 bad input, 3 numerical failure or output that cannot
    be written, 130 interrupted.
    """
    from tribo.cli.lab_report import print_report
    from tribo.core.errors import CaseError
    from tribo.observers.progress import Progress
    from tribo.result.checkpoint import RunFolder
    from tribo.result.read import Result
    from tribo.simulation.run import Simulation

    with Result.open(output) as stopped:
        case, made, status = stopped.case_tables, stopped.provenance, stopped.status
    if status == "done" and not RunFolder(output.resolve()).path.is_dir():
        click.echo(f"{output} is done; see it with: tribo show {output}")
        return
    try:
        simulation = Simulation(case)
    except CaseError as error:
        makers = {f"{o['distribution']} {o['version']}" for o in made["components"].values()}
        files = (each for each in made["plugins"] if each["origin"] == "file")
        makers |= {f"--plugin {each['distribution']}" for each in files}
        listed = ", ".join(sorted(makers - {" "}))
        raise CaseError(f"{error} (the run was begun with {listed})") from error
    with simulation.resume(output, observers=[Progress()], allow_changed=allow_changed) as result:
        print_report(result)
