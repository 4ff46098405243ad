"""`tribo scar`."""

from __future__ import annotations

import math
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

import click
from tribo import CaseError
from tribo.kernel_api import (
    JSON,
    PATH,
    check_output,
    echo_json,
    located,
    write_file,
)

if TYPE_CHECKING:
    from tribo import Surface

    from tribo_scar.measurement import MeasuredScar

DEPTHS = ".npy"
"""Suffix of a depth map."""


@click.command()
@click.argument("files", nargs=-1, required=True, type=PATH, metavar="[BEFORE] AFTER")
@click.option("--ideal", metavar="SURFACE", help="Take this shape before the test, as in a case.")
@click.option(
    "--pitch",
    multiple=True,
    metavar="LENGTH",
    help="Take this distance of pixels; give it twice for x and y.",
)
@click.option("--unit", default="m", show_default=True, help="Unit of heights, as µm.")
@click.option("--radius", metavar="LENGTH", help="Use formulas for a ball of this radius.")
@click.option(
    "--track-length", metavar="LENGTH", help="Take a track of this length, by default the map's."
)
@click.option(
    "--form", type=int, default=1, help="Remove this form: 1 for tilt, 2 for curvature too."
)
@click.option(
    "-o",
    "--output",
    multiple=True,
    type=PATH,
    help="Write a picture, as scar.png, or the depth map, as depth.npy; may be repeated.",
)
@JSON
def scar(
    files: tuple[Path, ...],
    ideal: str | None,
    pitch: tuple[str, ...],
    unit: str,
    radius: str | None,
    track_length: str | None,
    form: int,
    output: tuple[Path, ...],
    as_json: bool,
) -> None:
    """Measure a scar between two height maps, BEFORE and AFTER a test.

    The maps are laid on each other (shift, rotation, tilt) by their unworn
    surface, and subtracted. Files are NumPy or CSV with heights, which need
    --pitch, or in a format that a plugin reads, such as tribo-topography. x is the
    sliding direction; what is missing is NaN. With one file, --ideal gives the
    shape before the test.

    \b
    Example:
      tribo scar before.x3p after.x3p --radius '5 mm' -o scar.png -o depth.npy
      tribo scar after.npy --pitch '1 um' --unit um --ideal '{ type = "sphere", radius = "5 mm" }'
    """
    from tribo import Quantity, read_heights
    from tribo.kernel_api import Console, picture_format

    from tribo_scar.measurement import measured_scar

    def length(option: str, text: str | None, most: float | None = None) -> float | None:
        with located(option):
            return None if text is None else Quantity("m", above=0, at_most=most).read(text)

    for path in output:
        check_output(path)
        if path.resolve() in {each.resolve() for each in files}:
            raise CaseError(f"{path} is a measured map; give another name", "--output")
        if path.suffix.lower() != DEPTHS:
            with located("--output"):
                picture_format(path.suffix or ".png")
    if len(files) != (1 if ideal else 2):
        count = "1 file is" if len(files) == 1 else f"{len(files)} files are"
        raise CaseError(
            f"{count} given; give the maps before and after, or the one after and the shape "
            'before it, as --ideal \'{ type = "sphere", radius = "5 mm" }\''
        )
    if len(pitch) > 2:
        raise CaseError("give one --pitch, or two, along x and along y")
    # Beyond 1 mm between two pixels the unit is a wrong one.
    steps = [length("--pitch", text, 1e-3) or 0.0 for text in pitch]
    maps = [read_heights(path, (steps[0], steps[-1]) if steps else None, unit) for path in files]
    before, lengths = _surface(ideal) if ideal else maps[0], (radius, track_length)
    ball, track = map(length, ("--radius", "--track-length"), lengths)
    with Console(stderr=True).status("Laying the maps on each other, and measuring the scar"):
        found = measured_scar(before, maps[-1], radius=ball, track_length=track, form=form)
    written = [_write(found, path, maps[-1].heights.shape) for path in output]
    if as_json:
        echo_json(found.as_json() | {"written": list(map(str, written))})
        return
    _print(found)
    for path in written:
        click.echo(f"Wrote {path}")


def _write(found: MeasuredScar, path: Path, shape: tuple[int, ...]) -> Path:
    """Write the depth at each pixel of the map after, NaN where missing, or a picture.

    Return the file.
    """
    if path.suffix.lower() == DEPTHS:
        import numpy as np

        # The middle of the map stays, as a fit takes it as the middle of the contact.
        depths = np.full(shape, np.nan)
        depths[found.registration.part] = found.depths
        image = BytesIO()
        np.save(image, depths)
        write_file(path, image.getbuffer())
        return path
    from tribo.kernel_api import write_figures

    from tribo_scar.picture import measured_scar_map

    pictures = {path.stem: lambda: measured_scar_map(found)}
    (picture,) = write_figures(pictures, path.parent, path.suffix or ".png")
    return picture


def _surface(text: str) -> Surface:
    """Return the surface that an option gives as a case does."""
    from pydantic import TypeAdapter, ValidationError
    from tribo import Surface
    from tribo.kernel_api import case_error, located, parse_value

    with located("--ideal"):
        given = parse_value(text)
    try:
        surface: Surface = TypeAdapter(Surface).validate_python(given)
    except ValidationError as error:
        raise CaseError(f"--ideal {case_error(error)}") from None
    return surface


def _row(name: str, scale: float, value: float | None, uncertainty: float) -> tuple[str, str, str]:
    """Return a value and its uncertainty, in units of which `scale` make one of SI, in words."""
    from tribo.kernel_api import digits_of

    from tribo_scar.measurement import MOST_DIGITS

    if value is None or math.isinf(uncertainty):
        return name, "undetermined", ""
    if math.isinf(value):
        return name, "whole map", ""
    size, off = abs(scale * value), scale * uncertainty
    digits = min(digits_of(size - off, size + off), MOST_DIGITS)
    return name, f"{scale * value:#.{digits}g}", f"{off:#.2g}"


def _print(found: MeasuredScar) -> None:
    from tribo.kernel_api import Console, DataTable, Heading, TableRow, inferred_table

    laid, console = found.registration, Console()
    relative = found.volume_uncertainty / found.volume
    rows = [
        _row("volume in the map, mm³", 1e9, found.volume, found.volume_uncertainty),
        _row("largest depth, µm", 1e6, found.depth, found.depth_uncertainty),
        _row("length along sliding, mm", 1e3, found.along, found.along_uncertainty or 0.0),
        _row("width across, mm", 1e3, found.across, found.across_uncertainty or 0.0),
        *(
            _row(name, scale, value, relative * value)
            for name, scale, value in (
                ("mean section, mm²", 1e6, found.section),
                ("volume of the track, mm³", 1e9, found.track_volume),
            )
            if value is not None
        ),
    ]
    if found.piled_up:
        rows.append(_row("volume piled up, mm³", 1e9, found.piled_up, found.piled_up_uncertainty))
    if found.missing:
        rows.append(("missing pixels in the scar, %", f"{100 * found.missing:.3g}", ""))
    if found.outliers:
        rows.append(("outliers in both maps", str(found.outliers), ""))
    moved = laid.shift_uncertainty
    rows += [
        _row("shift of the map after along x, µm", 1e6, laid.shift[0], moved[0]),
        _row("shift of the map after along y, µm", 1e6, laid.shift[1], moved[1]),
        _row("rotation of the map after, mrad", 1e3, laid.rotation, laid.rotation_uncertainty),
        ("noise of the unworn difference, nm", f"{1e9 * laid.noise:.3g}", ""),
    ]
    headings = list(map(Heading, ("", "value", "standard uncertainty")))
    console.table(DataTable("Scar", headings, [TableRow(row) for row in rows]))
    if found.inferred:
        console.table(inferred_table(found.inferred))
