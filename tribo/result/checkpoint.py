"""Keep the whole state of a run beside its results, so that it can go on.

A checkpoint is a sealed file that takes the place of the one before at once;
one before it is kept. It holds every bit of the state.
"""

from __future__ import annotations

import io
import json
import warnings
from collections.abc import Mapping
from contextlib import closing
from hashlib import sha256
from pathlib import Path
from uuid import uuid4

import h5py

from tribo.core.contact import ContactSolution, Residuals
from tribo.core.errors import CaseError, OutputError, TriboWarning
from tribo.core.fields import WearRate
from tribo.core.measures import Invariants
from tribo.core.notices import Notice
from tribo.core.state import BodyState, State
from tribo.result.guarded import GuardedFile
from tribo.result.journal import journal_path
from tribo.result.read import Result
from tribo.result.seal import write_sealed
from tribo.result.sealed_writer import SealedWriter
from tribo.result.store import write_array, write_text


def checkpoint_path(result: Path) -> Path:
    """Return where the checkpoint of a result file is kept."""
    return result.with_name(result.name + ".ckpt")


def previous_path(result: Path) -> Path:
    """Return where the checkpoint before the last one is kept."""
    return result.with_name(result.name + ".ckpt.prev")


def fingerprint(case: Mapping[str, object]) -> str:
    """Return what tells the checkpoint of one case from that of another."""
    return sha256(json.dumps(case, sort_keys=True).encode()).hexdigest()


def write_checkpoint(
    result: Path,
    state: State,
    wall_time: float,
    case: Mapping[str, object],
    *,
    sync: bool = True,
    keep: bool = True,
) -> None:
    """Replace the checkpoint of `result` by `state`.

    Parameters
    ----------
    result : Path
        The result file.
    state : State
        What to keep.
    wall_time : float
        Time spent so far, in s.
    case : Mapping
        The configuration of the run, as plain data.
    sync : bool, optional
        Whether to wait until it would outlive a power failure.
    keep : bool, optional
        Whether the one that it replaces becomes the one before; else that stays.
    """
    image = io.BytesIO()
    with h5py.File(image, "w", libver="earliest") as file:
        file.attrs["case"] = fingerprint(case)
        _write_state(file, state, wall_time)
    path = checkpoint_path(result)
    if keep and path.exists():
        path.replace(previous_path(result))
    write_sealed(path, image.getvalue(), identity=uuid4().bytes, sync=sync)


def read_checkpoint(result: Path, case: Mapping[str, object]) -> tuple[State, float]:
    """Return the last good state of `result` and the time spent until then.

    Parameters
    ----------
    result : Path
        The result file.
    case : Mapping
        Its configuration, as plain data; a checkpoint of another is refused.

    Raises
    ------
    CaseError
        If there is no readable checkpoint.
    """
    with Result.open(result) as rows:
        saves, steps = len(rows.times), rows.totals()["steps"]
    reasons = []
    for path in (checkpoint_path(result), previous_path(result)):
        if not path.exists():
            continue
        try:
            with closing(GuardedFile.open(path)) as kept:
                if kept.attribute("case") != fingerprint(case):
                    reasons.append(f"{path.name} belongs to another case")
                    continue
                with kept.reading("its state"):
                    state, wall_time = _read_state(kept)
        except CaseError as error:
            reasons.append(str(error))
            continue
        if state.saves > saves or state.steps > steps:
            reasons.append(f"{path.name} counts rows that {result.name} lacks")
            continue
        if reasons:
            warnings.warn(
                f"{'; '.join(reasons)}: going on from {path.name}, at {state.time:.6g} s",
                TriboWarning,
                stacklevel=2,
            )
        return state, wall_time
    raise CaseError(
        f"{result} has no checkpoint to resume from: "
        + ("; ".join(reasons) or "its run was stopped before the first was written")
        + "; start again with 'tribo run --force'"
    )


def remove_checkpoint(result: Path) -> None:
    """Delete the checkpoints of a run that is done, one that was not finished too."""
    path = checkpoint_path(result)
    path.with_name(path.name + ".new").unlink(missing_ok=True)
    previous_path(result).unlink(missing_ok=True)
    path.unlink(missing_ok=True)


def tidied(result: Path) -> bool:
    """Put away what a run that was killed as it ended left beside its result.

    Returns
    -------
    bool
        Whether there was anything.

    Raises
    ------
    OutputError
        If the result cannot be written.
    """
    if not (checkpoint_path(result).exists() or journal_path(result).exists()):
        return False
    try:
        with closing(SealedWriter(result)) as file:
            file.commit(sync=True)
    except OSError as error:
        raise OutputError(f"cannot write {result}: {error}") from error
    remove_checkpoint(result)
    return True


_SCALARS = (
    "time",
    "distance",
    "speed",
    "increment",
    "reference_depth",
    "steps",
    "rejected_steps",
    "contact_solves",
    "solver_iterations",
    "saves",
)


def _write_state(file: h5py.File, state: State, wall_time: float) -> None:
    contact = state.contact
    scalars = {name: getattr(state, name) for name in _SCALARS}
    scalars["notices"] = [vars(notice) for notice in state.notices]
    scalars["approach"] = contact.approach
    scalars["iterations"] = contact.iterations
    scalars["residuals"] = vars(contact.residuals)
    scalars["invariants"] = vars(state.invariants)
    scalars["wall_time"] = wall_time
    scalars["bodies"] = {name: sorted(body.law) for name, body in state.bodies.items()}
    scalars["rates"] = {name: sorted(rate.state_rates) for name, rate in state.rates.items()}
    # json writes floats so that they read back to the same bits.
    write_text(file, "scalars", json.dumps(scalars))
    write_array(file, "pressure", contact.pressure)
    write_array(file, "overlap", contact.overlap)
    if state.previous is not None:
        write_array(file, "previous", state.previous)
    for name, body in state.bodies.items():
        write_array(file, f"bodies/{name}/wear", body.wear)
        write_array(file, f"bodies/{name}/plastic", body.plastic)
        for field, values in body.law.items():
            write_array(file, f"bodies/{name}/law/{field}", values)
    for name, rate in state.rates.items():
        write_array(file, f"rates/{name}/depth", rate.depth_rate)
        write_array(file, f"rates/{name}/derivative", rate.depth_slope)
        for field, values in rate.state_rates.items():
            write_array(file, f"rates/{name}/state/{field}", values)


def _read_state(file: GuardedFile) -> tuple[State, float]:
    scalars = json.loads(file.text("scalars"))
    contact = ContactSolution(
        pressure=file.array("pressure"),
        approach=scalars["approach"],
        overlap=file.array("overlap"),
        iterations=scalars["iterations"],
        residuals=Residuals(**scalars["residuals"]),
    )
    bodies = {
        name: BodyState(
            wear=file.array(f"bodies/{name}/wear"),
            plastic=file.array(f"bodies/{name}/plastic"),
            law={field: file.array(f"bodies/{name}/law/{field}") for field in fields},
        )
        for name, fields in scalars["bodies"].items()
    }
    rates = {
        name: WearRate(
            depth_rate=file.array(f"rates/{name}/depth"),
            depth_slope=file.array(f"rates/{name}/derivative"),
            state_rates={field: file.array(f"rates/{name}/state/{field}") for field in fields},
        )
        for name, fields in scalars["rates"].items()
    }
    state = State(
        **{name: scalars[name] for name in _SCALARS},
        bodies=bodies,
        contact=contact,
        rates=rates,
        notices=tuple(Notice(**notice) for notice in scalars["notices"]),
        invariants=Invariants(**scalars["invariants"]),
        previous=file.array("previous") if "previous" in file.file else None,
    )
    return state, scalars["wall_time"]
