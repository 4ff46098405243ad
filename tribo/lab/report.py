"""What a lab would report of a result: one place for the table and the JSON."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from tribo.closed_forms.hertz import first_yield_pressure
from tribo.core.measures import reaches_border
from tribo.lab.conversion import (
    in_mm3_per_newton_metre,
    mass_from_volume,
    specific_wear_rate,
)
from tribo.lab.first_contact import AT_THE_CAP, computed_pressure, hertz_contact
from tribo.lab.inferred import InferredVolume, inferred_volumes, track_section
from tribo.lab.scar import scar
from tribo.registry.contributions import LabRow, from_plugins_of
from tribo.result.read import Result

HALF_SPACE = "dcfft"
"""The contact type that Hertz's theory is the smooth limit of."""


@dataclass(frozen=True)
class BodyReport:
    """What a lab would report of one body after a run.

    Parameters
    ----------
    volume : float
        Worn volume of the whole scar or track, in m³.
    mass : float or None
        The same, in kg; None without a density.
    specific_wear_rate : float or None
        In mm³/(N·m); None before any sliding.
    scar_along : float or None
        Extent along the sliding direction, in m; None for a swept body, whose
        scar is the whole track.
    scar_across : float
        Extent across it, in m; 0 where nothing is worn.
    track_section : float or None
        Area of a swept body's groove in section, in m²; None for another body.
    max_wear_depth, max_plastic_depth : float
        In m.
    """

    volume: float
    mass: float | None
    specific_wear_rate: float | None
    scar_along: float | None
    scar_across: float
    track_section: float | None
    max_wear_depth: float
    max_plastic_depth: float


@dataclass(frozen=True)
class FirstContact:
    """The contact before any sliding.

    Parameters
    ----------
    max_pressure : float
        As computed, in Pa.
    hertz_peak_pressure : float or None
        In Pa; None where the surfaces give no Hertz contact.
    yield_ratio : float or None
        `max_pressure`, or the pressure at mid-length of a line contact, over that at which a
        Hertz contact first yields beneath the surface; None without a hardness or a Hertz
        contact.
    yields : str or None
        The same in words; None where nothing can be said.
    computed : str
        The computed pressures in words.
    comparable : bool
        Whether the two pressures ought to agree: half-spaces, in contact
        within the window.
    """

    max_pressure: float
    hertz_peak_pressure: float | None
    yield_ratio: float | None
    yields: str | None
    computed: str
    comparable: bool


@dataclass(frozen=True)
class LabReport:
    """The bodies after the last save, by name, and the first contact.

    `inferred` are the volumes by a lab's formulas, beside those worn; `rows`
    what the plugins of its models add.
    """

    bodies: Mapping[str, BodyReport]
    inferred: tuple[InferredVolume, ...]
    first_contact: FirstContact
    rows: tuple[LabRow, ...] = ()

    def as_json(self) -> dict[str, Any]:
        """Return the report as plain data, its keys named with their units."""
        first = self.first_contact
        return {
            "bodies": {
                name: {
                    "specific_wear_rate_mm3_per_Nm": body.specific_wear_rate,
                    "mass_kg": body.mass,
                    "scar_along_m": body.scar_along,
                    "scar_across_m": body.scar_across,
                    "track_section_m2": body.track_section,
                }
                for name, body in self.bodies.items()
            },
            "inferred_volumes": [
                {
                    "body": each.body,
                    "method": each.method,
                    "standard": each.standard,
                    "volume_m3": each.volume,
                    "relative_error": each.relative_error,
                }
                for each in self.inferred
            ],
            "first_contact": {
                "hertz_peak_pressure_Pa": first.hertz_peak_pressure,
                "max_pressure_Pa": first.max_pressure,
                "yield_ratio": first.yield_ratio,
            },
            "plugins": [row._asdict() for row in self.rows],
        }


def lab_report(result: Result) -> LabReport:
    """Return what a lab would report of `result` at its last save."""
    saves = result.saves()
    return LabReport(
        bodies={name: _body(result, name, saves[-1]) for name in result.body_names},
        inferred=tuple(inferred_volumes(result)),
        first_contact=_first_contact(result, saves[0]),
        rows=tuple(row for rows in from_plugins_of(result, "tribo_lab_rows") for row in rows),
    )


def yield_words(pressure: float, hardness: float, *, line: bool = False) -> str:
    """Say whether the softer body yields under a peak pressure of a Hertz contact.

    Parameters
    ----------
    pressure : float
        In Pa; see `tribo.lab.first_contact.computed_pressure`.
    hardness : float
        Of the softer body, in Pa; see `tribo.closed_forms.hertz.first_yield_pressure`.
    line : bool, optional
        Whether it is a line contact.
    """
    if pressure >= AT_THE_CAP * hardness:
        return "the softer body yields from the start: the pressure is its hardness"
    onset = "1.79" if line else "1.6"
    ratio = pressure / first_yield_pressure(hardness, line=line)
    percent = f"{100 * ratio:.0f} %"
    if ratio > 1:
        return (
            f"the softer body yields beneath the surface at first (at {percent} of "
            f"{onset} H/2.8), which this model leaves out"
        )
    return (
        f"{percent} of the pressure at which the softer body first yields beneath the surface "
        f"({onset} H/2.8)"
    )


def _body(result: Result, name: str, save: Mapping[str, Any]) -> BodyReport:
    body, worn = result.body(name), save["bodies"][name]
    volume, distance = worn["wear_volume_m3"], save["distance_m"]
    marks = scar(body.wear_depth[-1], result.grid)
    rate = None
    if distance > 0:
        rate = in_mm3_per_newton_metre(specific_wear_rate(volume, result.system.load, distance))
    return BodyReport(
        volume=volume,
        mass=None if body.density is None else mass_from_volume(volume, body.density),
        specific_wear_rate=rate,
        scar_along=None if body.swept else marks.along,
        scar_across=marks.across,
        track_section=track_section(result, body),
        max_wear_depth=worn["max_wear_depth_m"],
        max_plastic_depth=worn["max_plastic_depth_m"],
    )


def _first_contact(result: Result, save: Mapping[str, Any]) -> FirstContact:
    system, max_pressure = result.system, save["max_pressure_Pa"]
    pressure, computed = computed_pressure(system, max_pressure, save["centre_pressure_Pa"])
    hertz = hertz_contact(system)
    ratio = words = None
    if system.cap is not None and hertz is not None:
        ratio = pressure / first_yield_pressure(system.cap, line=hertz.is_line)
        words = yield_words(pressure, system.cap, line=hertz.is_line)
    return FirstContact(
        max_pressure=max_pressure,
        hertz_peak_pressure=None if hertz is None else hertz.peak_pressure,
        yield_ratio=ratio,
        yields=words,
        computed=computed,
        comparable=result.case.get("contact", {}).get("type") == HALF_SPACE
        and not reaches_border(result.field("pressure", 0)),
    )
