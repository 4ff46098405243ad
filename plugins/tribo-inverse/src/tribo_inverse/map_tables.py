"""Tables, files and pictures of local coefficients for `tribo calibrate`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict
from functools import partial
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
import numpy as np
from tribo.kernel_api import DataTable, Heading, TableRow, write_file

from tribo_inverse.calibration.maps import SILENT, FittedMaps, LocalMap
from tribo_inverse.calibration.quantities import p_words

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def maps_json(found: FittedMaps, level: float) -> dict[str, Any]:
    """Return fitted maps as plain data, in SI units."""
    return {
        "level": level,
        "gradients": found.gradients,
        "products": found.products,
        "chi_square": found.chi_square,
        "degrees_of_freedom": found.degrees_of_freedom,
        "p_value": found.p_value,
        "notes": found.notes,
        "findings": [asdict(each) for each in found.findings],
        "maps": {
            name: {key: value.tolist() for key, value in _arrays(each, level).items()}
            for name, each in found.maps.items()
        },
    }


def _arrays(each: LocalMap, level: float) -> dict[str, Any]:
    lower, upper = each.interval(level)
    return {
        "spacing_m": np.array(each.spacing),
        "factor": each.factor,
        "lower": lower,
        "upper": upper,
        "deviation": each.deviation,
        "prior_deviation": each.prior,
        "told": each.told,
        "measured_m": each.measured,
        "computed_m": each.computed,
        "uncertainty_m": each.uncertainty,
    }


def maps_table(found: FittedMaps, level: float) -> DataTable:
    """Return the range of the factors, the cells where it differs from 1, and the fit."""
    title = f"Local coefficients, by {found.gradients + found.products} runs and passes back"
    below = f"cells below 1, at {100 * level:g} %"
    columns, rows = ("map", "known cells", "factor in these", below, "cells above 1"), []
    for name, each in found.maps.items():
        told, (lower, upper) = each.told, each.interval(level)
        ends = each.factor[told] if np.any(told) else np.ones(1)
        counts = told, told & (upper < 1), told & (lower > 1)
        cells, *differ = (str(np.sum(count)) for count in counts)
        there = f"{ends.min():.2f} to {ends.max():.2f}"
        rows.append(TableRow((name, f"{cells} of {told.size}", there, *differ)))
    fit = (
        f"χ² {found.chi_square:.4g} with {found.degrees_of_freedom:.4g} degrees of freedom, "
        f"{p_words(found.p_value)}. A cell is known where less than {SILENT:g} of the prior's "
        "standard deviation is left."
    )
    return DataTable(title, list(map(Heading, columns)), rows, (fit,))


def write_maps(found: FittedMaps, level: float, output: Path) -> None:
    """Write the maps as a NumPy archive, and a picture of each beside it."""
    from tribo.kernel_api import write_figures

    from tribo_inverse.pictures import coefficient_map

    arrays: dict[str, Any] = {}
    pictures: dict[str, Callable[[], Figure]] = {}
    for name, each in found.maps.items():
        arrays |= {f"{name}_{key}": value for key, value in _arrays(each, level).items()}
        pictures[f"{output.stem}-{name}"] = partial(coefficient_map, each, level, name)
    image = BytesIO()
    np.savez_compressed(image, **arrays)
    write_file(output, image.getbuffer())
    click.echo(f"Wrote {output}")
    for path in write_figures(pictures, output.parent):
        click.echo(f"Wrote {path}")
