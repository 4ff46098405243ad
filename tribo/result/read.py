"""Read a result back."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import numpy as np

from tribo.core.arrays import Array
from tribo.core.contact import ContactSystem
from tribo.core.errors import CaseError
from tribo.core.fields import Field
from tribo.core.grid import Grid
from tribo.result.body import BodyResult, checked_save
from tribo.result.columns import BODY_COLUMNS, COLUMNS, INVARIANTS, labelled
from tribo.result.guarded import GuardedFile
from tribo.result.store import FORMAT
from tribo.result.stored import StoredCase, StoredProvenance, stored

SAME_TIME = 1e-9
"""How far a time may be off that of a save, relative to the last one."""
STATUSES = ("done", "running", "interrupted", "failed")
_LISTED = 8


class Result:
    """A finished, stopped or running simulation, read from its file.

    Use it as a context manager, or `close` it. Arrays are read when asked for.

    Parameters
    ----------
    file : GuardedFile
        The open file; most users call `Result.open`.
    """

    def __init__(self, file: GuardedFile) -> None:
        self._file = file
        self.name = file.name

    @classmethod
    def open(cls, path: str | Path) -> Self:
        """Open a result file.

        What is read from it is held against its checksums when it is read.

        Raises
        ------
        CaseError
            If there is no such file, it is not a tribo result, or it is
            damaged at its root.
        """
        result = cls(GuardedFile.open(Path(path)))
        found = result._file.attribute("tribo_format", None)
        if not np.array_equal(found, FORMAT):
            result.close()
            raise CaseError(f"{path} is a tribo result of format {found}, not {FORMAT}")
        return result

    def __repr__(self) -> str:
        if not self._file.file:
            return f"<Result {self.name}: closed>"
        times = self.times
        listed = [f"{time:g}" for time in times]
        if len(listed) > _LISTED:
            listed = [*listed[: _LISTED - 2], "…", listed[-1]]
        saves = f"{len(times)} save{'' if len(times) == 1 else 's'}"
        at = f" at {', '.join(listed)} s" if listed else ""
        return f"<Result {self.name}: {self.status}, {saves}{at}>"

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def check(self) -> None:
        """Hold the whole file against its checksums.

        Raises
        ------
        CaseError
            If it is damaged, with what of it cannot be read.
        """
        self._file.check()

    @property
    def status(self) -> str:
        """``"done"``, ``"running"``, ``"interrupted"`` or ``"failed"``."""
        status = self._file.attribute("status")
        with self._file.reading("'status'"):
            if status not in STATUSES:
                raise ValueError(f"it is {status!r:.60}; {', '.join(STATUSES)} are known")
        return str(status)

    @property
    def wall_time(self) -> float | None:
        """Time the run took, in s; None of one that is still running, or was killed."""
        if self.status == "running":
            return None
        return self._file.numbers("wall_time_s")[0]

    @property
    def case(self) -> dict[str, Any]:
        """The full configuration, as plain data."""
        return dict(self._stored("case", self._file.text("case"), StoredCase))

    @property
    def provenance(self) -> dict[str, Any]:
        """Versions and classes that made the result."""
        return dict(self._stored("provenance", self._file.text("provenance"), StoredProvenance))

    @property
    def notices(self) -> tuple[str, ...]:
        """Warnings given during the run."""
        text = str(self._file.attribute("notices", "[]"))
        return tuple(self._stored("notices", text, list[str]))

    @property
    def system(self) -> ContactSystem:
        """Window, load, contact modulus, pressure cap and initial curvature."""
        file = self._file
        attributes = file.file.attrs
        lx, ly = file.numbers("window_m", 2, above=0)
        (modulus,) = file.numbers("modulus_Pa", above=0)
        (load,) = file.numbers("load_N", above=0)
        cap = file.numbers("cap_Pa", above=0)[0] if "cap_Pa" in attributes else None
        curved = file.numbers("curvature_1_m", 2) if "curvature_1_m" in attributes else None
        curvature = None if curved is None else (curved[0], curved[1])
        return ContactSystem(Grid((lx, ly), self._cells), modulus, load, cap, curvature)

    @property
    def grid(self) -> Grid:
        """The window."""
        return self.system.grid

    @property
    def times(self) -> Array:
        """Time of each save, in s."""
        return self._list("time")

    @property
    def distances(self) -> Array:
        """Path slid at each save, in m."""
        return self._file.array("saves/distance", shapes=[self.times.shape], finite=True)

    @property
    def body_names(self) -> tuple[str, ...]:
        """Names of the bodies in the order of the case."""
        return tuple(self.case["bodies"])

    def pressure(self, save: int) -> Array:
        """Return the contact pressure at a save, shape (nx, ny), in Pa.

        Saves count from 0; -1 is the last.

        Raises
        ------
        CaseError
            If there is no such save.
        """
        save = checked_save(save, len(self.times), self.name)
        return self._file.array("pressure", save, shapes=[self._shape], finite=True)

    def wear_depth(self, body: str, save: int) -> Array:
        """Return the worn depth of a body at a save, shape (nx, ny), in m.

        Saves count from 0; -1 is the last. Reads no other save, as `Result.body` does.

        Raises
        ------
        CaseError
            If there is no such body or save.
        """
        self._check_body(body)
        save = checked_save(save, len(self.times), self.name)
        path = f"bodies/{body}/wear_depth"
        depth = self._file.array(path, save, shapes=self._on_surface, finite=True)
        return np.broadcast_to(depth, self._cells)

    def save_at(self, time: float) -> int:
        """Return the index of the save at `time`.

        Parameters
        ----------
        time : float
            In s; may be off by rounding.

        Raises
        ------
        CaseError
            If nothing was saved then; the message lists the times.
        """
        times = self.times
        if len(times):
            nearest = int(np.argmin(np.abs(times - time)))
            if abs(times[nearest] - time) <= SAME_TIME * times[-1]:
                return nearest
        listed = ", ".join(f"{saved:g}" for saved in times)
        raise CaseError(f"{self.name} has no save at {time:g} s; its saves are at {listed} s")

    def body(self, name: str) -> BodyResult:
        """Return what is kept of a body.

        Raises
        ------
        CaseError
            If there is no body of that name.
        """
        self._check_body(name)
        with self._file.reading(f"'bodies/{name}'"):
            group = self._file.file[f"bodies/{name}"]
            swept, weighed = bool(group.attrs["swept"]), "density_kg_m3" in group.attrs
        kept, provided = self._fields(name, "state"), self._fields(name, "effects")
        return BodyResult(
            name=name,
            swept=swept,
            density=self._file.numbers("density_kg_m3", above=0, of=f"bodies/{name}")[0]
            if weighed
            else None,
            height=self._file.array(f"bodies/{name}/height", shapes=[self._cells], finite=True),
            wear_depth=self._on_window(f"bodies/{name}/wear_depth"),
            plastic_depth=self._file.array(
                f"bodies/{name}/plastic_depth", shapes=[self._shape], finite=True
            ),
            state={f.name: self._on_window(f"bodies/{name}/state/{f.name}") for f in kept},
            state_fields=kept,
            effects={
                f.name: self._file.array(f"bodies/{name}/effects/{f.name}", shapes=[self._shape])
                for f in provided
            },
            effect_fields=provided,
        )

    def table(self, name: str) -> dict[str, Array]:
        """Return ``"saves"`` or ``"history"`` as columns, named with their units.

        A body's columns are called ``bodies.NAME.wear_volume_m3`` and so on.
        """
        rows = self.times if name == "saves" else self._list(f"{name}/step")
        paths = {column.label: f"{name}/{column.name}" for column in COLUMNS}
        for body in self.body_names:
            for part in BODY_COLUMNS:
                paths[f"bodies.{body}.{part.label}"] = f"{name}/bodies/{body}/{part.name}"
        return {
            label: self._file.array(path, shapes=[rows.shape], finite=True)
            for label, path in paths.items()
        }

    def saves(self) -> list[dict[str, Any]]:
        """Return the scalars of each save, those of the bodies under ``bodies``."""
        table = self.table("saves")
        rows: list[dict[str, Any]] = []
        for i in range(len(self.times)):
            row: dict[str, Any] = {c.label: float(table[c.label][i]) for c in COLUMNS}
            row["bodies"] = {
                body: {
                    part.label: float(table[f"bodies.{body}.{part.label}"][i])
                    for part in BODY_COLUMNS
                }
                for body in self.body_names
            }
            rows.append(row)
        return rows

    def summary(self) -> dict[str, Any]:
        """Return the whole result but its fields, as plain data.

        ``tribo show --json`` prints it, with what a lab would report added.
        """
        return {
            "case": self.case,
            "status": self.status,
            "provenance": self.provenance,
            "notices": list(self.notices),
            "totals": dict(self.totals()),
            "invariants": dict(self.worst()),
            "saves": self._saves_with_ranges(),
        }

    def _saves_with_ranges(self) -> list[dict[str, Any]]:
        rows = self.saves()
        for body in self.body_names:
            for field in self._fields(body, "effects"):
                for i, row in enumerate(rows):
                    path = f"bodies/{body}/effects/{field.name}"
                    values = self._file.array(path, i, shapes=[self._shape])
                    low, high = float(np.min(values)), float(np.max(values))
                    ranges = row["bodies"][body].setdefault("effects", {})
                    failed = math.isnan(low)
                    ranges[labelled(field.name, field.unit)] = {
                        "min": None if failed else low,
                        "max": None if failed else high,
                    }
        return rows

    def totals(self) -> Mapping[str, Any]:
        """Return what the run cost: solves, iterations, steps and `wall_time`."""
        history = self.table("history")
        steps = len(history["time_s"])
        last = -1 if steps else slice(0)
        return {
            "steps": max(steps - 1, 0),
            "contact_solves": int(np.sum(history["contact_solves"][last])),
            "solver_iterations": int(np.sum(history["solver_iterations"][last])),
            "wall_time_s": self.wall_time,
        }

    def worst(self) -> Mapping[str, float]:
        """Return the worst value, over all steps, of each invariant that the run was held to."""
        columns = [column for column in COLUMNS if column.name in INVARIANTS]
        return {c.label: float(np.max(self._list(f"history/{c.name}"), initial=0)) for c in columns}

    def _fields(self, body: str, kind: str) -> tuple[Field, ...]:
        """Return the fields that are kept of a body, of its law's state or of the effects."""
        path = f"bodies/{body}/{kind}"
        with self._file.reading(repr(path)):
            group = self._file.file.get(path, {})
            return tuple(
                Field(name, str(values.attrs["units"]), str(values.attrs["long_name"]))
                for name, values in group.items()
            )

    def _check_body(self, name: str) -> None:
        if name not in self.body_names:
            raise CaseError(
                f"{self.name} has no body {name!r}; its bodies are {', '.join(self.body_names)}"
            )

    def _on_window(self, name: str) -> Array:
        """Return a body's own field at every save, spread along x where the body is swept."""
        values = self._file.array(name, shapes=self._on_surface, finite=True)
        if values.ndim == 2:
            values = np.broadcast_to(values[:, None, :], self._shape)
        return values

    @property
    def _cells(self) -> tuple[int, int]:
        nx, ny = len(self._list("x")), len(self._list("y"))
        with self._file.reading("'x' and 'y'"):
            if not nx * ny:
                raise ValueError("they are empty")
        return nx, ny

    @property
    def _shape(self) -> tuple[int, int, int]:
        """Shape of a field of the window at every save."""
        return len(self.times), *self._cells

    @property
    def _on_surface(self) -> tuple[tuple[int, ...], ...]:
        """Shapes of a field of a body's surface at every save; a swept one has no x."""
        saves, nx, ny = self._shape
        return (saves, nx, ny), (saves, ny)

    def _list(self, name: str) -> Array:
        values = self._file.array(name, finite=True)
        with self._file.reading(repr(name)):
            if values.ndim != 1:
                raise ValueError(f"its shape is {values.shape}; a list is needed")
        return values

    def _stored(self, name: str, text: str, kind: type) -> Any:
        with self._file.reading(repr(name)):
            return stored(text, kind)
