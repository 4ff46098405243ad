"""The limits of the pressure cap: none below it, A = F/H far above."""

from __future__ import annotations

import math

import numpy as np

from tribo.contact.winkler import Winkler
from tribo.core.arrays import Array
from tribo.core.grid import Grid
from tribo.core.material import Material
from tribo.core.measures import contact_area
from tribo.model.model import Model
from tribo.motion.reciprocating import Reciprocating
from tribo.simulation.assembly import assemble, varied
from tribo.stepping.first_contact import first_contact
from tribo.stepping.step import start_sliding
from tribo.verification import paper_bodies as paper
from tribo.verification.reference import Row, norm, reference

SOURCE = "Tian & Bhushan (1996); Almqvist et al. (2007)"
HARDNESS, ONSET = paper.HARDNESS, paper.ONSET


def _window(load: float, cells: int) -> Grid:
    return paper.square(3 * math.sqrt(max(load, 2 * ONSET) / HARDNESS / math.pi), cells)


def _soft(load: float, cells: int) -> Model:
    soft = Material(young=paper.YOUNG, poisson=paper.POISSON, hardness=HARDNESS)
    grid = _window(load, cells)
    return paper.on_flat(paper.BALL, grid, paper.HALF_SPACE, load=load, material=soft)


def _part(name: str, depth: Array, deepest: float, tolerance: float, note: str) -> Row:
    return Row(name, "1", 0.0, float(np.max(depth)) / deepest, tolerance, note=note)


@reference("hardness, ball at 0.98 of the load of first yield", SOURCE, 95)
def _below(cells: int, placement: float) -> list[Row]:
    load = 0.98 * ONSET
    grid = _window(load, cells)
    gap = paper.paraboloid(grid)
    capped = paper.press(paper.HALF_SPACE, gap, grid, load, HARDNESS)
    elastic = paper.press(paper.HALF_SPACE, gap, grid, load).pressure
    name, note = "sum |p - p_elastic| / sum p", "no effect below the cap"
    return [
        norm(name, capped.pressure, elastic, 1e-8, note=note),
        Row("plastic depth", "m", 0.0, float(np.max(capped.overlap)), 0.0, note=note),
    ]


@reference("hardness, ball at 5, 10, 20 times that load", SOURCE, 5, 10, 20)
def _above(factor: int, placement: float) -> list[Row]:
    load = factor * ONSET
    model = _soft(load, 127)
    state = first_contact(model)
    pressure = state.contact.pressure
    # A disc under H throughout: its edge is where the bodies just touch. What the ball reaches
    # into the flat there, less what the flat's surface is dished elastically, is permanent.
    radius = math.sqrt(load / HARDNESS / math.pi)
    dished = (2 - 4 / math.pi) * HARDNESS * radius / paper.MODULUS
    left = radius**2 / (2 * paper.RADIUS) - dished
    depth = sum(float(np.max(body.plastic)) for body in state.bodies.values())
    mean = load / contact_area(pressure, model.grid)
    growing = "tends to H with the load, not the grid"
    uniform = "limit of uniform pressure"
    return [
        Row("peak pressure", "Pa", HARDNESS, float(np.max(pressure)), 1e-12, note="the cap itself"),
        Row("mean pressure", "Pa", HARDNESS, mean, 1e-2, note=growing),
        Row("plastic depth of both bodies", "m", left, depth, 1e-2, note=uniform),
    ]


GROOVE = "the envelope of the indentation along the track"


@reference("hardness, ball draws a groove as it begins to slide", GROOVE, 33)
def _groove(cells: int, placement: float) -> list[Row]:
    model = _soft(3 * ONSET, cells)
    state = start_sliding(model, first_contact(model))
    depth = state.bodies["flat"].plastic
    deepest, rest = float(np.max(depth)), state.contact.overlap
    return [
        _part("variation along the groove / depth", np.ptp(depth, axis=0), deepest, 0.0, "exact"),
        _part("further depth / depth", rest, deepest, 1e-6, "at rest to tolerance"),
    ]


STIFFNESS, RISE = 1.3e15, 0.5
"""Of springs, in Pa/m; by how much the approach exceeds that at which the pressure reaches H."""
ON_SPRINGS = "closed form: p = H - K x^2/2R in the groove, K (d - r^2/2R) beside it"


def _on_springs(cells: int) -> tuple[Model, float]:
    """Return a ball that slides on a softer flat on springs, and the depth of its groove, in m."""
    first = HARDNESS / STIFFNESS
    # Half-breadths of the groove and the contact, in which the load is a sum over the rows.
    groove, half = (math.sqrt(2 * paper.RADIUS * first * rise) for rise in (RISE, 1 + RISE))
    y, spacing = np.linspace(groove, half, 2001, retstep=True)
    beside = np.maximum((half**2 - y**2) / (2 * paper.RADIUS), 0.0)
    heights = 2 * groove * first**1.5 + 2 * float(np.trapezoid(beside**1.5, dx=spacing))
    load = 4 / 3 * STIFFNESS * math.sqrt(2 * paper.RADIUS) * heights
    soft = Material(young=paper.YOUNG, poisson=paper.POISSON, hardness=HARDNESS)
    grid, springs = paper.square(3 * half, cells), Winkler(modulus=STIFFNESS)
    model = paper.on_flat(paper.BALL, grid, springs, load=load, flat_material=soft)
    return model, RISE * first


@reference("hardness, ball on springs draws a groove of known depth", ON_SPRINGS, 25)
def _groove_depth(cells: int, placement: float) -> list[Row]:
    averaged, exact = _on_springs(cells)
    stroke = 2 * cells * averaged.grid.spacing[0]
    to_and_fro = Reciprocating(stroke=stroke, frequency=1.0, cycles=1, positions="cells")
    rows = []
    for name, model in (
        ("once round a track", averaged),
        ("every cell of a stroke", assemble(varied(averaged.case, kinematics=to_and_fro))),
    ):
        depth = start_sliding(model, first_contact(model)).bodies["flat"].plastic
        deepest = float(np.max(depth[len(depth) // 2]))
        rows.append(Row(f"plastic depth, {name}", "m", exact, deepest, 2e-2, note="cells"))
    return rows


@reference("hardness, ball pressed again into its indentation", SOURCE, 95)
def _again(cells: int, placement: float) -> list[Row]:
    load = 5 * ONSET
    grid = _window(load, cells)
    gap = paper.paraboloid(grid)
    first = paper.press(paper.HALF_SPACE, gap, grid, load, HARDNESS).overlap
    same, half = (
        paper.press(paper.HALF_SPACE, gap + first, grid, part * load, HARDNESS).overlap
        for part in (1, 0.5)
    )
    name, deepest = "further depth / depth", float(np.max(first))
    return [
        _part(f"{name}, same load", same, deepest, 1e-6, "at rest to tolerance"),
        _part(f"{name}, half the load", half, deepest, 0.0, "unloads elastically"),
    ]
