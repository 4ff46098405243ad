"""The laboratory report of a result: the numbers of the table and of the JSON."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from math import isnan, nan
from typing import Any, NamedTuple

import numpy as np

from tribo.core.errors import warn
from tribo.core.words import readable, said
from tribo.lab.against_hertz import compared, first_hertz
from tribo.lab.inferred import InferredVolume, inferred_volumes, track_section
from tribo.lab.scar import scar
from tribo.lab.units import shown_in
from tribo.registry.hookspecs import LabRow
from tribo.registry.registry import from_plugins_of, place, process_kept
from tribo.result.read import Result
from tribo.result.summary import worst

MEASURES = (
    ("mass", "mg", "mass_kg", 1e6, ".3g"),
    ("specific wear rate", "mm³/(N·m)", "specific_wear_rate_mm3_per_Nm", 1.0, ".3g"),
    ("scar along sliding", "mm", "scar_along_m", 1e3, ".3f"),
    ("scar across", "mm", "scar_across_m", 1e3, ".3f"),
    ("section of the track", "mm²", "track_section_m2", 1e6, ".3g"),
)
"""Name, unit, key, factor to the unit, and format of a lab's measurements of a body."""


class BodyReport(NamedTuple):
    """The laboratory report of one body after a run; its names carry the units.

    The specific wear rate is None before any sliding, and the mass without a
    density. The scar is 0 wide where nothing is worn; the scar of a swept body
    is the whole track, which has no extent along the sliding direction, and a
    section instead.

    Examples
    --------
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> result = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse).run()
    >>> ball = result.report().bodies["ball"]
    >>> round(ball.specific_wear_rate_mm3_per_Nm, 12), round(1e3 * ball.scar_across_m, 2)
    (3.11e-07, 0.32)
    """

    specific_wear_rate_mm3_per_Nm: float | None  # noqa: N815
    mass_kg: float | None
    scar_along_m: float | None
    scar_across_m: float
    track_section_m2: float | None


class FirstContact(NamedTuple):
    """The contact before any sliding.

    The ratio is the largest pressure, or the pressure at mid-length of a line
    contact, over the pressure at which a Hertz contact first yields beneath the
    surface, and `load_ratio` the load over Hertz's load of first yield; None
    unless both bodies have a hardness, or without a Hertz contact.

    Examples
    --------
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> result = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse).run()
    >>> first = result.report().first_contact
    >>> round(first.max_pressure_Pa / first.hertz_peak_pressure_Pa, 2)  # springs against Hertz
    1.31
    """

    hertz_peak_pressure_Pa: float | None  # noqa: N815
    max_pressure_Pa: float  # noqa: N815
    yield_ratio: float | None
    load_ratio: float | None


@dataclass(frozen=True)
class LabReport:
    """The bodies after the last save, by name, and the first contact.

    `first_contact_words` compare it with Hertz and the onset of yield.
    `inferred` are the volumes by a lab's formulas, with their errors; ``rows``
    are from the plugins of its models.

    Examples
    --------
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> result = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse).run()
    >>> report = result.report()
    >>> {name: f"{1e6 * body.mass_kg:.1g} mg" for name, body in report.bodies.items()}
    {'ball': '0.0003 mg', 'disk': '0.0003 mg'}
    """

    bodies: Mapping[str, BodyReport]
    inferred: tuple[InferredVolume, ...]
    first_contact: FirstContact
    first_contact_words: str
    rows: tuple[LabRow, ...] = ()

    def as_json(self) -> dict[str, Any]:
        """Return the report as plain data."""
        return {
            "bodies": {name: body._asdict() for name, body in self.bodies.items()},
            "inferred_volumes": [each._asdict() for each in self.inferred],
            "first_contact": self.first_contact._asdict(),
            "plugins": [row._asdict() for row in self.rows],
        }


def lab_report(result: Result) -> LabReport:
    """Return the laboratory report of `result` at its last save."""
    first, words = _first_contact(result)
    return LabReport(
        bodies={name: _body(result, name) for name in result.body_names},
        inferred=tuple(inferred_volumes(result)),
        first_contact=first,
        first_contact_words=words,
        rows=tuple(quantity_rows(result)),
    )


def quantity_rows(result: Result) -> list[LabRow]:
    """Return a row for each quantity of a result, and of its bodies; none where it is NaN."""
    rows: dict[str, LabRow] = {}
    for column in from_plugins_of(result, "tribo_quantities"):
        for of in product(result.body_names) if column.of_bodies else [()]:
            key, value = ".".join(("quantities", *of, column.label)), nan
            try:
                if key in rows:
                    raise ValueError("another package has a quantity of this name")
                with process_kept():
                    value = float(column.read(result, *of))
            except Exception as error:
                where = place(error, column.read.__module__)
                warn(f"{key} is left out: it raised {said(error)}{where}")
            if not isnan(value):
                unit = "" if column.unit == "1" else column.unit
                rows[key] = LabRow(" of ".join((column.description, *of)), value, unit, key=key)
    return [*rows.values()]


def lab_sentences(result: Result, lab: LabReport) -> Iterator[str]:
    """Yield the sentences below the tables: first contact, yield, friction, rows of plugins."""
    yield lab.first_contact_words
    saves = result.saves()
    last = saves[-1]
    plastic = [save["plastic_area_m2"] / save["contact_area_m2"] for save in (saves[0], last)]
    if max(plastic) > 0:
        start, end = (f"{100 * part:.2g} %" for part in plastic)
        yield f"At the hardness: {start} of the contact at first, {end} at the end."
    force, work = last.get("friction_force_N"), last.get("friction_energy_J")
    if force is not None and work is not None:
        yield f"Friction: {force:.4g} N at the end, {work:.4g} J dissipated."
    for row in lab.rows:
        unit, size = shown_in(row.unit, np.array(row.value))
        yield str(row._replace(value=row.value / size, unit=unit))


def run_sentences(result: Result) -> Iterator[str]:
    """Yield the size of a run, and its worst residuals."""
    totals, off = result.totals(), worst(result)
    took = "" if result.wall_time is None else f", {readable(result.wall_time, '.1f')} s"
    yield f"{totals['steps']} steps, {totals['contact_solves']} contact solves{took}."
    yield (
        f"At worst: load off by {off['force_error']:.0e}, worn volume by "
        f"{off['volume_error']:.0e}, gap under pressure {off['complementarity_error']:.0e}, "
        f"overlap {off['penetration_error']:.0e}."
    )


def _body(result: Result, name: str) -> BodyReport:
    body, save = result.body(name), result.saves()[-1]
    volume, distance = save["bodies"][name]["wear_volume_m3"], save["distance_m"]
    marks = scar(body.wear_depth[-1], result.grid)
    rate = 1e9 * volume / save["load_distance_N_m"] if distance > 0 else None
    return BodyReport(
        specific_wear_rate_mm3_per_Nm=rate,
        mass_kg=None if body.density is None else volume * body.density,
        scar_along_m=None if body.swept else marks.along,
        scar_across_m=marks.across,
        track_section_m2=track_section(result, body),
    )


def _first_contact(result: Result) -> tuple[FirstContact, str]:
    hertz, save = first_hertz(result), result.saves()[0]
    largest = save["max_pressure_Pa"]
    ratio, words = compared(result.system, hertz, largest, save["centre_pressure_Pa"])
    p0, load_ratio = (hertz.peak_pressure, hertz.load_ratio) if hertz else (None, None)
    return FirstContact(p0, largest, ratio, load_ratio), f"First contact: {words}."
