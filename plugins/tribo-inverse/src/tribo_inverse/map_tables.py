"""Table, file and picture of local coefficients for `tribo calibrate`."""

from __future__ import annotations

from dataclasses import asdict
from io import BytesIO
from pathlib import Path
from typing import Any

import click
import numpy as np
from tribo.kernel_api import DataTable, Heading, TableRow, write_file

from tribo_inverse.calibration.maps import SILENT, FittedMap
from tribo_inverse.calibration.quantities import p_words


def map_json(found: FittedMap, level: float) -> dict[str, Any]:
    """Return a fitted map as plain data, in SI units."""
    return {
        "level": level,
        "gradients": found.gradients,
        "products": found.products,
        "chi_square": found.chi_square,
        "degrees_of_freedom": found.degrees_of_freedom,
        "p_value": found.p_value,
        "notes": found.notes,
        "findings": [asdict(each) for each in found.findings],
        "body": found.body,
        **{key: value.tolist() for key, value in _arrays(found, level).items()},
    }


def _arrays(found: FittedMap, level: float) -> dict[str, Any]:
    lower, upper = found.interval(level)
    return {
        "spacing_m": np.array(found.spacing),
        "factor": found.factor,
        "lower": lower,
        "upper": upper,
        "deviation": found.deviation,
        "prior_deviation": np.array(found.prior),
        "told": found.told,
        "measured_m": found.measured,
        "computed_m": found.computed,
        "uncertainty_m": found.uncertainty,
    }


def map_table(found: FittedMap, level: float) -> DataTable:
    """Return the range of the factors, the cells where it differs from 1, and the fit."""
    title = f"Local coefficients, by {found.gradients + found.products} runs and passes back"
    below = f"cells below 1, at {100 * level:g} %"
    columns = ("map", "known cells", "factor in these", below, "cells above 1")
    told, (lower, upper) = found.told, found.interval(level)
    ends = found.factor[told] if np.any(told) else np.ones(1)
    cells, *differ = (str(np.sum(told & part)) for part in (told, upper < 1, lower > 1))
    there = f"{ends.min():.2f} to {ends.max():.2f}"
    row = TableRow((found.body, f"{cells} of {told.size}", there, *differ))
    fit = (
        f"χ² {found.chi_square:.4g} with {found.degrees_of_freedom:.4g} degrees of freedom, "
        f"{p_words(found.p_value)}. A cell is known where less than {SILENT:g} of the prior's "
        "standard deviation is left."
    )
    return DataTable(title, list(map(Heading, columns)), [row], (fit,))


def write_map(found: FittedMap, level: float, output: Path) -> None:
    """Write a map as a NumPy archive, and a picture of it beside it."""
    from tribo.kernel_api import write_figures

    from tribo_inverse.pictures import coefficient_map

    image = BytesIO()
    np.savez_compressed(image, **_arrays(found, level))
    write_file(output, image.getbuffer())
    click.echo(f"Wrote {output}")
    figures = {output.stem: lambda: coefficient_map(found, level, found.body)}
    for path in write_figures(figures, output.parent):
        click.echo(f"Wrote {path}")
