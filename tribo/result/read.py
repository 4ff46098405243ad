"""A result: a dataset, and methods for the questions of a tribologist."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from contextlib import AbstractContextManager, ExitStack
from functools import cached_property
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from tribo.core.arrays import Array
from tribo.core.column import labelled
from tribo.core.contact import ContactSystem
from tribo.core.errors import CaseError
from tribo.core.fields import Field
from tribo.core.findings import Finding
from tribo.core.grid import Grid
from tribo.core.hdf5 import open_hdf5
from tribo.core.shorthand import call
from tribo.core.words import did_you_mean, suggestion, unknown
from tribo.result.body import BodyResult, checked_save
from tribo.result.hdf5 import read_variables
from tribo.result.header import Header
from tribo.result.layout import BETWEEN, EFFECT, HISTORY, STATE
from tribo.result.opening import interpreting, source_of
from tribo.result.sealed import write_sealed

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from matplotlib.figure import Figure

    from tribo.case import Case
    from tribo.lab.report import LabReport
    from tribo.plotting.figures import Plot


class Result(AbstractContextManager["Result"]):
    """A finished, stopped or running simulation.

    `dataset` has all of it, and each variable of that is an attribute:
    ``result.pressure.sel(time=200, method="nearest")``. Use it as a context
    manager, or `close` it.

    Parameters
    ----------
    source : Path or BytesIO
        The file; most users call `tribo.open`.
    name : str
        What to call it in messages.

    Examples
    --------
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> result = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse).run()
    >>> result.status, round(1e-6 * float(result.pressure.sel(time=0).max()))  # at first, in MPa
    ('done', 2815)
    """

    def __init__(self, source: Path | BytesIO, name: str) -> None:
        self.name = name
        self._source = source
        with interpreting(name), ExitStack() as unsound:
            self._file = unsound.enter_context(open_hdf5(source))
            self._header = Header.read(self._file.attrs)
            # Each is looked up in the file once, as that takes long.
            self._kept = dict(self._file.items())
            self._variables = read_variables(self._kept)
            small = [name for name, values in self._variables.items() if len(values.dims) <= 2]
            self._scalars = {name: self._read(name, ...) for name in small}
            if not (len(self.times) or self.status == "running"):
                raise ValueError("it holds no save")
            unsound.pop_all()

    @classmethod
    def open(cls, path: str | Path) -> Result:
        """Open a result file.

        The whole file is compared with its checksum. The file of a run in progress,
        or of a killed run, is assembled from its parts.

        Raises
        ------
        CaseError
            If there is no such file, it is not a tribo result, or it is damaged.

        Examples
        --------
        >>> from tempfile import TemporaryDirectory
        >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
        >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
        >>> with TemporaryDirectory() as folder:
        ...     case.run(f"{folder}/my.h5").close()
        ...     with tribo.open(f"{folder}/my.h5") as result:
        ...         round(float(result.max_wear_depth[-1, 0]) * 1e6, 1)  # µm
        1.0
        """
        return cls(source_of(Path(path)), str(path))

    def __repr__(self) -> str:
        if not self._file:
            return f"<Result {self.name}: closed>"
        until = f" up to {self.times[-1]:g} s" if len(self.times) else ""
        return f"<Result {self.name}: {self.status}, saves: {len(self.times)}{until}>"

    def __exit__(self, *error: object) -> None:
        self.close()

    def close(self) -> None:
        """Close the file."""
        if "dataset" in self.__dict__:
            self.dataset.close()
        self._file.close()

    @cached_property
    def dataset(self) -> xr.Dataset:
        """All of the result, as `xarray.open_dataset` gives it."""
        import xarray as xr

        return xr.open_dataset(self._source, engine="h5netcdf")

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name not in self._variables:
            meant = suggestion(did_you_mean(name, dir(self)))
            raise AttributeError(f"a result has no {name!r}{meant}")
        return self.dataset[name]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._variables]

    def save(self, path: str | Path) -> None:
        """Write the result to a file, in the place of what is there.

        Raises
        ------
        OutputError
            If it cannot be written.
        """
        source = self._source
        data = source.read_bytes() if isinstance(source, Path) else source.getvalue()
        write_sealed(Path(path), data)

    @property
    def status(self) -> str:
        """``"done"``, ``"running"``, ``"killed"``, ``"interrupted"`` or ``"failed"``."""
        return self._header.status

    @property
    def wall_time(self) -> float | None:
        """Duration of the run, in s; None for a run that is in progress, or was killed."""
        return self._header.wall_time

    @property
    def case(self) -> Case:
        """The case that was run; `CaseError` if a package or a class of one's own is missing."""
        case: Case = call("case", self.case_tables)
        return case

    @property
    def case_tables(self) -> dict[str, Any]:
        """The full configuration, as plain data in SI units."""
        return dict(self._header.case)

    @property
    def provenance(self) -> dict[str, Any]:
        """Versions and classes that made the result."""
        return dict(self._header.provenance)

    @property
    def findings(self) -> tuple[Finding, ...]:
        """The findings of the run: warnings, its beginning and the reason of its end."""
        return self._header.findings

    @property
    def warnings(self) -> tuple[str, ...]:
        """The findings, a sentence each."""
        return tuple(map(str, self.findings))

    @property
    def notices(self) -> tuple[str, ...]:
        """The former name of `warnings`; tribo 0.3 has only that."""
        words = "Result.notices is now Result.warnings; tribo 0.3 has only that"
        warnings.warn(words, DeprecationWarning, stacklevel=2)
        return self.warnings

    @property
    def system(self) -> ContactSystem:
        """Window, load, contact modulus, pressure cap and initial curvature."""
        return self._header.system((len(self._scalars["x"]), len(self._scalars["y"])))

    @property
    def grid(self) -> Grid:
        """The window."""
        return self.system.grid

    @property
    def times(self) -> Array:
        """Time of each save, in s."""
        return self._scalars["time"]

    @property
    def distances(self) -> Array:
        """Path slid at each save, in m."""
        return self._scalars["distance"]

    @property
    def body_names(self) -> tuple[str, ...]:
        """Names of the bodies in the order of the case."""
        return tuple(self._header.case["bodies"])

    def field(self, name: str, save: int, body: str | None = None) -> Array:
        """Return a field at a save as a NumPy array, shape (nx, ny).

        Parameters
        ----------
        name : str
            The variable, as ``"pressure"`` or ``"wear_depth"``.
        save : int
            Saves count from 0; -1 is the last.
        body : str, optional
            Whose, of a variable that each body has.

        Raises
        ------
        CaseError
            If there is no such variable, body or save, or it is not saved each time.
        """
        if name not in self._variables:
            meant = suggestion(did_you_mean(name, self._variables))
            raise CaseError(f"a result has no variable {name!r}{meant}")
        if self._variables[name].dims[0] != "time":
            raise CaseError(f"{name} has no value of its own at each save; see result.{name}")
        bodies = () if body is None else (self._index(body),)
        save = checked_save(save, len(self.times), self.name)
        return self._read(name, save, *bodies)

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
            # Tables and names of files have the digits of :g.
            if f"{times[nearest]:g}" == f"{time:g}":
                return nearest
        listed = ", ".join(f"{saved:g}" for saved in times)
        raise CaseError(f"{self.name} has no saved time {time:g} s; saved times: {listed} s")

    def body(self, name: str) -> BodyResult:
        """Return the data of a body.

        Raises
        ------
        CaseError
            If there is no body of that name.
        """
        index, density = self._index(name), self._scalars["density"]
        read, every = self._read, slice(None)

        def kept(kind: str) -> dict[str, Array]:
            fields = self.fields_of(kind, name).items()
            return {field.name: read(key, every, index) for key, field in fields}

        return BodyResult(
            name=name,
            swept=bool(self._scalars["swept"][index]),
            straight=float(self._scalars["swept"][index]) <= 1,
            density=None if np.isnan(density[index]) else float(density[index]),
            height=read("height", index),
            wear_depth=read("wear_depth", every, index),
            plastic_depth=read("plastic_depth", every, index),
            state=kept(STATE),
            effects=kept(EFFECT),
        )

    def table(self, name: str) -> dict[str, Array]:
        """Return ``"saves"`` or ``"history"`` as columns, named with their units.

        A body's are called ``bodies.NAME.max_wear_depth_m``. Columns of models follow.
        """
        dims = {"saves": "time", "history": "step"}
        if name not in dims:
            raise CaseError(f"there is no table {name!r}; give 'saves' or 'history'")
        dim = dims[name]
        columns, of_bodies = {}, {}
        for key, its in self._variables.items():
            label = labelled(its.field or key.removeprefix(HISTORY), its.unit)
            if its.dims == (dim,) and its.kind != BETWEEN and key != "step":
                columns[label] = self._scalars[key]
            elif its.dims == (dim, "body"):
                of_bodies[label] = self._scalars[key].T
        for index, body in enumerate(self.body_names):
            own = ((label, values[index]) for label, values in of_bodies.items())
            columns |= {f"bodies.{body}.{label}": v for label, v in own if not np.isnan(v).all()}
        return columns

    def saves(self) -> list[dict[str, Any]]:
        """Return the scalars of each of its saves, with the bodies' scalars under ``bodies``."""
        table, rows = self.table("saves"), []
        for i in range(len(self.times)):
            row = {label: float(v[i]) for label, v in table.items() if not np.isnan(v[i])}
            bodies: dict[str, dict[str, float]] = {body: {} for body in self.body_names}
            for label in [each for each in row if each.startswith("bodies.")]:
                _, body, own = label.split(".")
                bodies[body][own] = row.pop(label)
            rows.append({**row, "bodies": bodies})
        return rows

    def report(self) -> LabReport:
        """Return the laboratory report of the result."""
        report: LabReport = call("report", self)
        return report

    def show(self) -> None:
        """Print the saves and what a lab would report, as ``tribo show`` does."""
        call("show", self)

    @property
    def plot(self) -> Plot:
        """Pictures: ``plot("folder")`` writes all, ``plot.scar("ball")`` draws one on axes."""
        pictures: Plot = call("plot", self)
        return pictures

    def picture(self, name: str) -> Figure:
        """Draw the picture of a file that `plot` writes, such as ``"ball_scar"``."""
        figure: Figure = call("picture", self, name)
        return figure

    def to_dataframe(self) -> pd.DataFrame:
        """Return a row for each saved time, as `show` prints them: ``"p max (MPa)"``."""
        table: pd.DataFrame = call("saves", self).to_dataframe()
        return table

    def _repr_html_(self) -> str:
        """Show the saves and the pressure in a notebook."""
        return str(call("html", self))

    def totals(self) -> Mapping[str, Any]:
        """Return the cost of the run: solves, iterations, steps and `wall_time`."""
        history = self.table("history")
        return {
            "steps": max(len(history["time_s"]) - 1, 0),
            "contact_solves": int(np.sum(history["contact_solves"][-1:])),
            "solver_iterations": int(np.sum(history["solver_iterations"][-1:])),
            "wall_time_s": self.wall_time,
        }

    def fields_of(self, kind: str, body: str | None = None) -> dict[str, Field]:
        """Return the fields of a kind by variable, of one body if it is given.

        Kinds are ``"state"`` and ``"effect"``, and ``"between"`` for what effects keep of the
        contact as a whole.
        """
        return {
            name: Field(its.field, its.unit, its.meaning)
            for name, its in self._variables.items()
            if its.kind == kind and (body is None or body in its.bodies)
        }

    def _read(self, name: str, *index: Any) -> Array:
        with interpreting(self.name):
            return np.asarray(self._kept[name][index])

    def _index(self, body: str) -> int:
        if body not in self.body_names:
            raise CaseError(unknown("body", body, self.body_names), self.name)
        return self.body_names.index(body)


open = Result.open
