"""`tribo demo`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from tribo.cli.options import PATH
from tribo.core.words import readable

if TYPE_CHECKING:
    from rich.table import Table

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
    from tribo.cli.tables import print_report
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
            Console().print(_table(average, cycle))
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


def _table(average: Result, resolved: Result) -> Table:
    """Set what is left at the end by the average against that of the resolved cycle."""
    from tribo.cli.console import titled

    table = titled(f"After {_end(resolved)['distance_m']:.4g} m", "average", "resolved")
    ends = [_end(result) for result in (average, resolved)]
    bodies = [end["bodies"] for end in ends]
    for name, factor, form, values in (
        ("groove, largest depth, µm", 1e6, ".2f", [b["disk"]["max_wear_depth_m"] for b in bodies]),
        ("groove where sliding turns, µm", 1e6, ".2f", list(map(_turning, (average, resolved)))),
        ("ball, largest depth, µm", 1e6, ".2f", [b["ball"]["max_wear_depth_m"] for b in bodies]),
        ("contact along, mm", 2e3, ".2f", [end["contact_half_width_x_m"] for end in ends]),
        ("contact across, mm", 2e3, ".2f", [end["contact_half_width_y_m"] for end in ends]),
        ("pressure at the centre, MPa", 1e-6, ".0f", [end["centre_pressure_Pa"] for end in ends]),
        ("volume of the disk, mm³", 1e9, ".3g", [b["disk"]["wear_volume_m3"] for b in bodies]),
    ):
        table.add_row(name, *(readable(factor * value, form) for value in values))
    return table


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
