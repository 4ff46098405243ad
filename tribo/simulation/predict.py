"""What a case will do, from a cheap run on a coarse grid."""

from __future__ import annotations

from dataclasses import dataclass

from tribo.analysis.first_contact import HertzContact, hertz_contact
from tribo.config.stepping import ImplicitConfig
from tribo.core.errors import CaseError, NumericalError
from tribo.core.grid import Grid
from tribo.core.measures import Measures
from tribo.simulation.march import begin, march
from tribo.simulation.measure import measure
from tribo.simulation.model import Model, assemble

COARSE = 72
MARGINS = (1.5, 1.0)
LOOSE = ImplicitConfig(depth_tolerance=2e-2, pressure_tolerance=0.5, settle=0.1)
FIELDS_IN_MEMORY = 24
PADDED_ARRAYS = 12


@dataclass(frozen=True)
class Prediction:
    """An estimate of a run before it is made.

    Parameters
    ----------
    first : Measures
        The first contact, on the case's own grid.
    hertz : HertzContact or None
        The same by Hertz's theory.
    cells_across : tuple of float or None
        Cells across Hertz's contact along x and y.
    last : Measures or None
        The end of a run on a coarse grid in a wider window, good to some
        percent; None where that could not be computed.
    window_holds : bool or None
        Whether the contact stays inside the window; None where unknown.
    limitation : str or None
        Why the motion's averaging will not hold, if so.
    memory, file_size : float
        In bytes; upper estimates.
    """

    first: Measures
    hertz: HertzContact | None
    cells_across: tuple[float, float] | None
    last: Measures | None
    window_holds: bool | None
    limitation: str | None
    memory: float
    file_size: float


def predict(model: Model) -> Prediction:
    """Estimate what `model` will do, in about a second.

    Raises
    ------
    CaseError
        If the first contact does not fit the window.
    NumericalError
        If it cannot be solved.
    """
    first = measure(model, begin(model))
    hertz = hertz_contact(model.system)
    dx, dy = model.grid.spacing
    last = _coarse_run(model)
    holds = limitation = None
    if last is not None:
        lx, ly = model.grid.size
        inside = last.half_width_x < lx / 2 - dx and last.half_width_y < ly / 2 - dy
        holds = inside or model.ends_at_window
        limitation = model.kinematics.limitation(model.grid, last.half_width_x)
    cells = model.grid.cells[0] * model.grid.cells[1]
    fields = 1 + sum(1 if model.is_swept(body.name) else 2 for body in model.bodies)
    fields += sum(1 for body in model.bodies if model.is_swept(body.name))
    saves = len({0.0, model.end_time, *model.save_times})
    return Prediction(
        first=first,
        hertz=hertz,
        cells_across=None
        if hertz is None
        else (2 * hertz.half_width_x / dx, 2 * hertz.half_width_y / dy),
        last=last,
        window_holds=holds,
        limitation=limitation,
        memory=8.0 * cells * (FIELDS_IN_MEMORY + 4 * PADDED_ARRAYS),
        file_size=8.0 * cells * fields * saves,
    )


def _coarse_run(model: Model) -> Measures | None:
    if not model.contact.accepts_wear_compliance:
        return None
    for margin in MARGINS:
        largest = max(model.grid.size)
        cells = tuple(max(8, 2 * round(0.5 * COARSE * size / largest)) for size in model.grid.size)
        size = tuple(margin * size for size in model.grid.size)
        try:
            coarse = assemble(
                grid=Grid((size[0], size[1]), (cells[0], cells[1])),
                load=model.load,
                bodies=model.bodies,
                contact=model.contact,
                kinematics=model.kinematics,
                stepping=LOOSE,
                friction_coefficient=model.friction_coefficient,
                effects=model.effects,
                stop=model.stop,
                ends_at_window=True,
            )
            state = begin(coarse)
            for accepted in march(coarse, state):
                state = accepted.state
        except (CaseError, NumericalError):
            continue
        return measure(coarse, state)
    return None
