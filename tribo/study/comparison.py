"""Compare results: of variants of a case, or from any files."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager, ExitStack
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tribo.case import Case
from tribo.config.load import case_tables
from tribo.core import findings
from tribo.core.errors import CaseError, about
from tribo.core.findings import Finding
from tribo.core.shorthand import call
from tribo.lab.report import quantity_rows
from tribo.observers.progress import Progress
from tribo.result.read import Result
from tribo.result.summary import summary
from tribo.simulation.run import Simulation
from tribo.study.differences import differences
from tribo.study.runs import complete, own_files
from tribo.study.side_by_side import comparison_table
from tribo.study.variation import Point, points_of, short_labels, variants

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class Comparison(AbstractContextManager["Comparison"]):
    """Results side by side; the others are compared with the first.

    Use it as a context manager, or `close` it.

    Parameters
    ----------
    results : Mapping
        The open results by their labels.
    settings : Mapping, optional
        The settings of each, by label: values by path.

    Examples
    --------
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> with tribo.compare(case, {"load.normal": ["50 N", "100 N"]}) as loads:
    ...     {label: f"{result.distances[-1]:.1f} m" for label, result in loads.results.items()}
    {'50 N': '1.8 m', '100 N': '1.3 m'}
    """

    results: Mapping[str, Result]
    settings: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for label, result in self.results.items():
            if {*result.body_names} != {*self.bodies}:
                raise CaseError(
                    f"the bodies of {label} are called {' and '.join(result.body_names)}, of "
                    f"{self.reference} {' and '.join(self.bodies)}; call them alike in both cases, "
                    "and run again"
                )
        if not self.times:
            raise CaseError(
                "the results have no time of a save in common: "
                + "; ".join(f"{label} {result!r}" for label, result in self.results.items())
            )

    def __repr__(self) -> str:
        return f"<Comparison of {', '.join(self.results)}>"

    def show(self, times: Sequence[float] = ()) -> None:
        """Print what differs at `times`, in s, as ``tribo compare`` does; see `chosen_times`."""
        call("show_comparison", self, self.chosen_times(times))

    def to_dataframe(self, times: Sequence[float] = ()) -> pd.DataFrame:
        """Return a row for each result and time, with the columns of `Result.to_dataframe`.

        `times` are in s; all in common if left out.
        """
        import pandas as pd

        rows = {
            label: result.to_dataframe().iloc[[result.save_at(t) for t in times or self.times]]
            for label, result in self.results.items()
        }
        return pd.concat(rows, names=["result", ""]).reset_index("result").reset_index(drop=True)

    def picture(
        self, time: float | None = None, parts: Sequence[str] | None = None, ax: Any = None
    ) -> Figure:
        """Draw the results over each other at a time in common, in s, or at the last.

        A row of panels for each of `parts`: the pressure, ``""``, and surfaces of bodies, by name;
        all if left out. `ax` are axes to draw on, one for each panel.
        """
        at = self.times[-1] if time is None else time
        figure: Figure = call("overlay", self.results, at, parts, ax)
        return figure

    def _repr_html_(self) -> str:
        """Show in a notebook what differs at the last time in common."""
        return comparison_table(self, self.times[-1:])._repr_html_()

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Close the results."""
        for result in self.results.values():
            result.close()

    @property
    def reference(self) -> str:
        """The label of the first result."""
        return next(iter(self.results))

    @property
    def times(self) -> list[float]:
        """Times at which all results hold a save, in s."""
        first, *others = (result.times for result in self.results.values())
        # Alike as they are printed, as in `Result.save_at`.
        alike = [{f"{time:g}" for time in times} for times in others]
        return [float(time) for time in first if all(f"{time:g}" in times for times in alike)]

    @property
    def bodies(self) -> list[str]:
        """Names of the bodies, as in the first result."""
        return list(self.results[self.reference].body_names)

    @property
    def varied(self) -> list[str]:
        """Paths of the settings that vary."""
        return list(dict.fromkeys(path for point in self.settings.values() for path in point))

    @property
    def findings(self) -> list[Finding]:
        """Findings on other grids, and findings of the runs."""
        first = self.results[self.reference]
        apart = [label for label, result in self.results.items() if result.grid != first.grid]
        found = [findings.other_grid(apart, self.reference)] if apart else []
        of_runs: dict[str, tuple[Finding, list[str]]] = {}
        for label, result in self.results.items():
            if result.status != "done":
                found.append(findings.not_done(label, result.status))
            for each in result.findings:
                of_runs.setdefault(str(each), (each, []))[1].append(label)
        return found + [findings.of_runs(each, labels) for each, labels in of_runs.values()]

    def chosen_times(self, times: Sequence[float] = ()) -> list[float]:
        """Return the times to show: the times given, else the first and the last common one.

        Raises
        ------
        CaseError
            If a result has no save at one of them; the message lists the times.
        """
        for time in times:
            for result in self.results.values():
                result.save_at(time)
        return list(times) or sorted({self.times[0], self.times[-1]})

    def save(self, label: str, time: float) -> dict[str, Any]:
        """Return the scalars of a result at a time, as `Result.saves` gives them."""
        result = self.results[label]
        return result.saves()[result.save_at(time)]

    def as_json(self, times: Sequence[float] = ()) -> dict[str, Any]:
        """Return the comparison as plain data, in SI units.

        Results are as in ``tribo show --json``, differences at `times`, in s; at all in common if
        left out.
        """
        first, *others = self.results.items()
        return {
            "reference": self.reference,
            "findings": [asdict(each) for each in self.findings],
            "results": {
                label: summary(result)
                | {
                    "file": result.name,
                    "settings": dict(self.settings.get(label, {})),
                    "quantities": {row.key: row.value for row in quantity_rows(result)},
                }
                for label, result in self.results.items()
            },
            "differences": [
                {
                    "time_s": time,
                    "results": {
                        label: {
                            name: each._asdict()
                            for name, each in differences(result, first[1], time).items()
                        }
                        for label, result in others
                    },
                }
                for time in times or self.times
            ],
        }


def compare(
    what: Case | Mapping[str, Any] | str | Path | Sequence[Case | Result | str | Path],
    vary: Mapping[str, Sequence[Any]] | Sequence[Mapping[str, Any]] = (),
    folder: str | Path | None = None,
    *,
    labels: Sequence[str] | None = None,
    progress: bool = False,
) -> Comparison:
    """Run variants of a case, or take any cases and results, and set them side by side.

    Parameters
    ----------
    what : Case, Mapping, str, Path, or a sequence of Case, Result, str or Path
        A case that varies: itself, its tables, or its TOML file. Without
        `vary` a list of results, of result files and of cases, which are run
        first. The others are compared with the first.
    vary : Mapping or sequence of Mapping, optional
        Values by path, every combination of which is a variant; or the settings
        of each variant, values by path.
    folder : str or Path, optional
        Folder of the result files of variants; finished results in it are
        reused. In memory if left out.
    labels : sequence of str, optional
        Names of the variants or of the items of the list; if left out the values
        that differ, or stems of files, or whole names where stems are alike.
    progress : bool, optional
        Whether to show on stderr which run is in progress, with a bar.

    Returns
    -------
    Comparison
        With the open results.

    Raises
    ------
    CaseError
        If a variant is not valid, before any is run; if a file is not a result,
        or damaged; or if the results have no save in common, or bodies of other
        names.
    TriboError
        If a run fails; the message names the variant.

    Examples
    --------
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> tribo.compare(case, {"bodies.ball.surface.radius": ["5 mm", "10 mm"]})
    <Comparison of 5 mm, 10 mm>
    """
    settings, cases = list[Point](), dict[str, Case]()
    if isinstance(what, Sequence) and not isinstance(what, str):
        if vary:
            raise CaseError("a list of results has nothing to vary; give one case")
        given, names = list(what), labels or _names(what)
    else:
        settings = points_of(vary)
        cases = variants(case_tables(what), settings)
        given, names = list(cases.values()), labels or short_labels(settings)
    if len(given) < 2:
        raise CaseError(f"{len(given)} to compare; give 2 or more, or what varies in a case")
    if len(names) != len(given) or len(set(names)) != len(names):
        raise CaseError(
            f"{len(given)} results need as many different labels, and have {', '.join(names)}; "
            "give each result once, or labels of your own in Python"
        )
    files = own_files(cases, Path(folder)) if cases and folder else [None] * len(given)
    with ExitStack() as unless_kept:
        results: dict[str, Result] = {}
        for name, each, file in zip(names, given, files, strict=True):
            if progress:
                print(f"{len(results) + 1} of {len(given)}, {name}", file=sys.stderr)
            results[name] = unless_kept.enter_context(_result(name, each, file, progress))
        comparison = Comparison(results, dict(zip(names, settings, strict=False)))
        unless_kept.pop_all()
    return comparison


def _result(
    name: str, given: Case | Result | str | Path, file: Path | None, progress: bool
) -> Result:
    """Return a result, of a file or after its case is run; of a variant in a file of its own."""
    if isinstance(given, Result):
        return given
    if isinstance(given, str | Path) and Path(given).suffix != ".toml":
        return Result.open(given)
    watchers = [Progress()] * progress
    with about(name):
        simulation = Simulation(given)
        if file is None:
            return simulation.run(observers=watchers)
        return complete(simulation, file, watchers)


def _names(given: Sequence[Case | Result | str | Path]) -> list[str]:
    """Return a name for each: the stem of a file, whole where stems are alike, or a number."""
    files = [Path(each) for each in given if isinstance(each, str | Path)]
    stems = len({path.stem for path in files}) == len(files)
    names = []
    for number, each in enumerate(given, start=1):
        if isinstance(each, str | Path):
            names.append(Path(each).stem if stems else str(each))
        else:
            names.append(f"{'case' if isinstance(each, Case) else 'result'} {number}")
    return names
