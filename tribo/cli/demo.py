"""`tribo demo`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from tribo.cli.options import PATH

if TYPE_CHECKING:
    from tribo.core.data_table import DataTable
    from tribo.result.read import Result

RESOLVED = ("kinematics.positions=33", "grid.cells=64")
"""What the resolved hour has of its own; 256² cells would take minutes."""
AVERAGE = """\
This is the paper's model: it averages the disk's wear over the stroke.
The same hour follows, with the cycle resolved into 33 positions along the stroke,
on 64² cells; it takes ten to thirty seconds."""

LIKE = {
    "ball_scar": "like the paper's figure 4, which was measured",
    "disk_scar": "like figure 5, which was measured",
    "pressure_map_early": "like figure 8",
    "pressure_sections": "like figure 9",
    "ball_profiles": "like figures 10 and 11",
}
"""The paper's figures that pictures stand for."""


@click.command()
@click.option(
    "-d",
    "--directory",
    type=PATH,
    default="tribo-demo",
    show_default=True,
    help="Folder to write to.",
)
@click.option("--force", is_flag=True, help="Replace the results of an earlier demo.")
def demo(directory: Path, force: bool) -> None:
    """Run the paper's one-hour ball-on-disk test, print its table, draw its pictures.

    First with the paper's average over the stroke, then with the cycle resolved.

    \b
    Example:
      tribo demo -d somewhere
    """
    from tribo.cli.console import Console
    from tribo.cli.lab_report import print_report
    from tribo.config.load import load_case
    from tribo.core.writing import check_new, make_folder, write_file
    from tribo.observers.progress import Progress
    from tribo.plotting.figures import save_figures
    from tribo.simulation.run import Simulation
    from tribo.templates import template

    case, output, followed = (
        directory / name for name in ("ball_on_disk.toml", "ball_on_disk.h5", "resolved.h5")
    )
    make_folder(directory)
    for path in (case, output, followed):
        check_new(path, force, "choose another folder with -d, or replace it with --force")
    write_file(case, template("ball_on_disk"))
    click.echo("One hour of a steel ball rubbing on a steel disk: 100 N, 25 Hz, 360 m.")
    averaged = Simulation(load_case(case))
    resolved = Simulation(load_case(case, overrides=RESOLVED))
    with averaged.run(output, observers=[Progress()], overwrite=force) as average:
        print_report(average)
        pictures = save_figures(average, directory)
        click.echo(AVERAGE)
        with resolved.run(followed, observers=[Progress()], overwrite=force) as cycle:
            Console().table(_table(average, cycle))
            deep, shallow = (_end(result)["bodies"]["disk"] for result in (average, cycle))
            excess = deep["max_wear_depth_m"] / shallow["max_wear_depth_m"] - 1
            click.echo(
                "With the paper's printed k over these 360 m, the average makes the\n"
                f"groove {100 * excess:.0f} % too deep: "
                'docs/paper.md ("What the average costs").'
            )
            pictures += _pictures(average, cycle, directory)
    click.echo(f"Case, results and {len(pictures)} pictures are in {directory}/:")
    for path in (case, output, followed, *pictures):
        like = LIKE.get(path.stem)
        click.echo(f"  {path.name:24}{like}" if like else f"  {path.name}")
    click.echo(f"To hand the result on: tribo report {output} (comes with tribo-report)")


def _end(result: Result) -> dict[str, Any]:
    return result.saves()[-1]


def _table(average: Result, resolved: Result) -> DataTable:
    """Set what is left at the end by the average against that of the resolved cycle."""
    from tribo.core.data_table import DataTable, Heading, TableRow

    ends = [_end(result) for result in (average, resolved)]
    bodies = [end["bodies"] for end in ends]
    row, turning = TableRow.scaled, list(map(_turning, (average, resolved)))
    rows = (
        row(
            "groove, largest depth, µm", (b["disk"]["max_wear_depth_m"] for b in bodies), 1e6, ".2f"
        ),
        row("groove where sliding turns, µm", turning, 1e6, ".2f"),
        row("ball, largest depth, µm", (b["ball"]["max_wear_depth_m"] for b in bodies), 1e6, ".2f"),
        row("contact along, mm", (end["contact_half_width_x_m"] for end in ends), 2e3, ".2f"),
        row("contact across, mm", (end["contact_half_width_y_m"] for end in ends), 2e3, ".2f"),
        row("pressure at the centre, MPa", (e["centre_pressure_Pa"] for e in ends), 1e-6, ".0f"),
        row("volume of the disk, mm³", (b["disk"]["wear_volume_m3"] for b in bodies), 1e9, ".3g"),
    )
    headings = list(map(Heading, ("", "average", "resolved")))
    return DataTable(f"After {ends[1]['distance_m']:.4g} m", headings, rows)


def _turning(result: Result) -> float:
    """Return the depth of the groove where the contact turns round, in m."""
    import numpy as np

    from tribo.lab.running_in import worn_surfaces

    track = worn_surfaces(result, "disk")[-1]
    if "track_x_m" not in track:
        return float(_end(result)["bodies"]["disk"]["max_wear_depth_m"])
    half = 0.5 * result.case["kinematics"]["stroke"]
    return float(np.interp(half, track["track_x_m"], track["track_depth_m"]))


def _pictures(average: Result, resolved: Result, directory: Path) -> list[Path]:
    """Draw the groove along the track, and sections of both results over each other."""
    from functools import partial

    from tribo.plotting.figures import write_figures
    from tribo.plotting.overlays import save_overlays
    from tribo.plotting.profiles import along_track

    results, end = {"average": average, "resolved": resolved}, float(average.times[-1])
    track = write_figures({"disk_along_track": partial(along_track, resolved, "disk")}, directory)
    return track + save_overlays(results, [end], directory)
