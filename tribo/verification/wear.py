"""Bodies that wear: laws under known pressure, springs, full contact, rigid limits, the paper."""

from __future__ import annotations

import math
import tomllib
from functools import partial
from typing import Any

import numpy as np

from tribo.closed_forms import ball_wear, hertz, sinusoid, winkler
from tribo.closed_forms.ball_on_track import ball_on_track
from tribo.contact.dcfft import DcFft
from tribo.contact.periodic import Periodic
from tribo.contact.winkler import Winkler
from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.core.measures import Measures, contact_area
from tribo.simulation.run import Simulation
from tribo.stepping.measure import measure
from tribo.templates import template
from tribo.verification import paper_bodies as paper
from tribo.verification.paper_bodies import BALL, LOAD, MODULUS, POISSON, RADIUS, YOUNG
from tribo.verification.reference import Reference, Row, reference
from tribo.wear.archard import Archard
from tribo.wear.law import WearLaw
from tribo.wear.power import Power

K = paper.WEAR_COEFFICIENT
HOUR = 360.0
"""Sliding distance of the paper's hour, in m."""
WAVELENGTH, AMPLITUDE = 1e-4, 1e-8
SPRINGS = "tribo.closed_forms.winkler; Johnson (1985), section 4.3"


def _volume(name: str, k: float, distance: float, got: float) -> Row:
    return Row(name, "m^3", k * LOAD * distance, got, 1e-10, note="V = kFs, exact")


@reference("ball on springs wears for 20 m, equal steps", SPRINGS, 40, 80, 160)
def _foundation(steps: int, placement: float) -> list[Row]:
    distance = 20.0
    # A foundation with this stiffness has Hertz's contact radius.
    stiffness = 16 * MODULUS / (3 * math.pi * 148.837e-6)
    model = paper.on_flat(BALL, paper.square(0.7e-3, 129), Winkler(modulus=stiffness))
    contact = paper.slide(model, distance, steps)[1].contact
    given = {"load": LOAD, "radius": RADIUS, "wear_coefficient": K}
    exact = float(winkler.worn_sphere_pressure(0.0, distance, stiffness=stiffness, **given))
    first = winkler.sphere(LOAD, RADIUS, stiffness).half_width
    radius = float(ball_wear.elastic_ball_half_width(distance, **given, initial_half_width=first))
    counted = math.sqrt(contact_area(contact.pressure, model.grid) / math.pi)
    by_volume = "follows from the volume, exact in the steps"
    cells = "exact in the steps; cells at its edge"
    return [
        Row("pressure at the centre", "Pa", exact, float(contact.pressure[64, 64]), 5e-3, 1.0),
        Row("approach", "m", radius**2 / (2 * RADIUS), contact.approach, 1e-4, note=by_volume),
        Row("contact radius, counted", "m", radius, counted, 2e-3, note=cells),
    ]


def _worn_ball(stiffer: int) -> Measures:
    hard = Material(young=YOUNG * stiffer, poisson=POISSON)
    contact, grid = DcFft(tolerance=1e-8), paper.square(1.2e-3, 65)
    model = paper.on_flat(BALL, grid, contact, distance=HOUR, material=hard)
    return measure(model, paper.slide(model, HOUR, 30)[1])


@reference("elastic ball wears for 360 m", "Argatov (2011)", 65)
def _elastic_ball(cells: int, placement: float) -> list[Row]:
    end = _worn_ball(1)
    first = hertz.point(MODULUS, LOAD, 1 / RADIUS, 1 / RADIUS).semi_axes[0]
    given = {"load": LOAD, "radius": RADIUS, "wear_coefficient": K, "initial_half_width": first}
    exact = float(ball_wear.elastic_ball_half_width(HOUR, **given))
    counted, note = math.sqrt(end.area / math.pi), "Argatov's law is good to 1 %"
    depth = end.bodies["ball"].centre_wear_depth
    return [
        Row("contact radius, counted", "m", exact, counted, 1.5e-2, note=note),
        Row("worn depth", "m", 26.509e-6, depth, 3e-3, note="an independent elastic run"),
        _volume("worn volume", K, HOUR, end.bodies["ball"].wear_volume),
    ]


RIGID = "ball wears for 360 m, 4, 16, 64 times as stiff: rigid limit"


@reference(RIGID, "Archard (1953); h = sqrt(kFs/(pi R))", 4, 16, 64)
def _rigid_ball(stiffer: int, placement: float) -> list[Row]:
    depth = _worn_ball(stiffer).bodies["ball"].centre_wear_depth
    exact = ball_wear.ball(HOUR, load=LOAD, radius=RADIUS, wear_coefficient=K).depth
    note = "order in the modulus, not the grid"
    return [Row("worn depth", "m", float(exact), depth, 1e-3, 1.0, note)]


def _wave(grid: Grid) -> Array:
    heights = AMPLITUDE * np.cos(2 * np.pi * grid.mesh[0] / WAVELENGTH)
    return np.broadcast_to(heights, grid.cells).copy()


def _full_contact(explicit: bool, steps: int, placement: float) -> list[Row]:
    compliance = float(sinusoid.compliance(2 * np.pi / WAVELENGTH, MODULUS))
    distance = compliance / K
    grid = Grid((WAVELENGTH, WAVELENGTH / 8), (16, 2))
    model = paper.on_flat(paper.Shape(heights=_wave), grid, Periodic(tolerance=1e-12), load=5.0)
    _, state = paper.slide(model, distance, steps, explicit=explicit)
    left = float(np.ptp(_wave(grid) - state.bodies["ball"].wear)) / float(np.ptp(_wave(grid)))
    # What one step of Euler's leaves, with k Δs/K of it worn.
    part = K * distance / steps / compliance
    stepwise = (1 - part if explicit else 1 / (1 + part)) ** steps
    exact, by_factor = float(sinusoid.worn_amplitude(distance, K, compliance)), "by Euler's factor"
    return [
        Row("amplitude left", "1", exact, left, 1e-2, 1.0),
        Row(f"amplitude left, {by_factor}", "1", stepwise, left, 1e-8, note="exact at any step"),
    ]


_IMPLICIT_WAVE, _EXPLICIT_WAVE = (
    Reference(
        f"wave in full contact, one decay length, {scheme} steps",
        "tribo.closed_forms.sinusoid",
        partial(_full_contact, scheme == "explicit"),
        (20, 40, 80),
    )
    for scheme in ("implicit", "explicit")
)


def _pin(law: WearLaw, pressure: float, distance: float, hardness: float | None = None) -> float:
    """Return the depth worn off a flat pin that presses evenly, in m."""
    pin, grid = paper.Shape(heights=lambda grid: np.zeros(grid.cells)), paper.square(1e-4, 4)
    soft = Material(young=YOUNG, poisson=POISSON, hardness=hardness)
    load = pressure * grid.size[0] ** 2
    model = paper.on_flat(pin, grid, paper.PERIODIC, load=load, ball_law=law, material=soft)
    _, state = paper.slide(model, distance, 2)
    return float(np.mean(state.bodies["ball"].wear))


LAWS = "h = k p s; k = K/H (Archard 1953); h = k p0 (p/p0)^m s (Rhee 1970)"


@reference("flat pin under even pressure wears", LAWS, 4)
def _flat_pin(level: int, placement: float) -> list[Row]:
    p, s, at, hardness = 0.4e9, 5.0, 1e9, paper.HARDNESS
    archard, ratio = K * p * s, K * hardness
    by_own = _pin(Archard(K=ratio, hardness=hardness), p, s)
    depths = {
        "archard by k": (archard, _pin(Archard(k=K), p, s)),
        "archard by K and its hardness": (archard, by_own),
        "archard by K and the body's hardness": (archard, _pin(Archard(K=ratio), p, s, hardness)),
    }
    for exponent in (1.5, 3.0):
        power = Power(k=K, p_exponent=exponent, reference_pressure=at)
        depths[f"power {exponent:g}"] = K * at * (p / at) ** exponent * s, _pin(power, p, s)
    return [
        Row(f"depth, {law}", "m", *depth, 1e-8, note="exact at any step")
        for law, depth in depths.items()
    ]


BOTH = "ball and flat wear, the flat by three times the coefficient"


@reference(BOTH, "V = kFs (Archard 1953)", 32)
def _both(cells: int, placement: float) -> list[Row]:
    distance, contact = 5.0, DcFft(tolerance=1e-8)
    grid = paper.square(0.7e-3, cells)
    model = paper.on_flat(BALL, grid, contact, flat_k=3 * K, distance=distance)
    bodies = measure(model, paper.slide(model, distance, 5)[1]).bodies
    return [
        _volume("volume of the ball", K, distance, bodies["ball"].wear_volume),
        _volume("volume of the flat", 3 * K, distance, bodies["flat"].wear_volume),
    ]


@reference("the paper's hour, ball and disk", "rigid limit: tribo.closed_forms.ball_on_track", 96)
def _paper(cells: int, placement: float) -> list[Row]:
    case: dict[str, Any] = tomllib.loads(template("ball_on_disk"))
    case["grid"] |= {"size": "1.4 mm", "cells": cells}
    case["output"] = {}
    model = Simulation(case).model
    end = measure(model, paper.run_to_end(model))
    worn = ball_on_track(
        end.distance,
        load=LOAD,
        radius=RADIUS,
        track_length=2e-3,
        ball_wear_coefficient=K,
        flat_wear_coefficient=K,
    )
    ball, disk = end.bodies["ball"], end.bodies["disk"]
    elastic = "the bodies are elastic; 0.6 % by an independent elastic run"
    counted = "counted: half a cell is 1.5 %"
    centre = worn.centre_pressure, end.centre_pressure
    compared = (
        ("depth of the ball", "m", worn.ball_depth, ball.centre_wear_depth, 1e-2, elastic),
        ("depth of the disk", "m", worn.flat_depth, disk.max_wear_depth, 1e-2, elastic),
        ("half-width along", "m", worn.half_width_along, end.half_width_x, 3e-2, counted),
        ("half-width across", "m", worn.half_width_across, end.half_width_y, 3e-2, counted),
        ("pressure at the centre", "Pa", *centre, 2e-2, elastic),
    )
    return [
        *(
            Row(name, unit, float(exact[0]), got, tolerance, note=note)
            for name, unit, exact, got, tolerance, note in compared
        ),
        _volume("volume of the ball", K, end.distance, ball.wear_volume),
        _volume("volume of the disk", K, end.distance, disk.wear_volume),
    ]
