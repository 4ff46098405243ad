"""The report of local coefficients."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from tribo_inverse.calibration.maps import FittedMaps
from tribo_inverse.calibration.quantities import p_words
from tribo_inverse.map_tables import fit_words, map_pictures, maps_table

from tribo_report.page import render, stills
from tribo_report.result import made_here


def maps_page(found: FittedMaps, level: float, title: str) -> str:
    """Return the report of local coefficients as HTML; see `tribo_report.write_report`."""
    pictures = map_pictures(found, level)
    return render(
        "study.html.j2",
        kind="Calibration",
        title=title,
        answers=list(_answers(found, level)),
        tables_title="Where coefficients differ",
        tables=[maps_table(found, level)],
        remarks=[fit_words(found)],
        notes=found.notes,
        stills=stills({_called(name): draw for name, draw in pictures.items()}),
        **made_here(),
    )


def _called(name: str) -> str:
    body, _, fit = name.partition("-fit")
    if fit or name.endswith("-fit"):
        return f"measured depth of the {body}, and the fit's distance from it"
    return f"factor on the coefficient of the {body}, and what is left of its uncertainty"


def _answers(found: FittedMaps, level: float) -> Iterator[str]:
    """Yield a warning of a misfit, then the factors on each coefficient with certainty."""
    if found.is_refuted:
        yield (
            f"No map that varies so smoothly explains the depths, {p_words(found.p_value)}; see "
            "the notes."
        )
    for name, each in found.maps.items():
        told, (lower, upper) = each.told, each.interval(level)
        if not np.any(told):
            yield f"The data do not determine where the coefficient of the {name} differs."
            continue
        ends = each.factor[told]
        parts = [np.sum(told & sure) / np.sum(told) for sure in (upper < 1, lower > 1)]
        yield (
            f"The coefficient of the {name} is {ends.min():.2f} to {ends.max():.2f} times the "
            f"case's where the data determine it; at {100 * level:g} % it is lower in "
            f"{100 * parts[0]:.0f} % of these cells and higher in {100 * parts[1]:.0f} %."
        )
