"""Run a case: the loop, its observers, its result."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

from tribo.case import Case
from tribo.component import components as named
from tribo.config.load import load_case
from tribo.core.errors import CaseError, Interrupted, TriboError, warn
from tribo.core.findings import Finding, failed
from tribo.core.state import BodyInfo, RunInfo, Snapshot, State
from tribo.core.writing import check_new
from tribo.evolution.measure import with_effects
from tribo.guards.guard import Guard
from tribo.model.model import Model
from tribo.observers.observer import Observer
from tribo.observers.recorder import Recorder
from tribo.registry.plugins import Plugin
from tribo.registry.registry import Registry, default_registry
from tribo.result.checkpoint import RunFolder
from tribo.result.provenance import changed_components, environment, origin
from tribo.result.read import Result
from tribo.simulation.audience import Audience
from tribo.simulation.beginning import checksum
from tribo.simulation.interrupt import interrupts_held
from tribo.simulation.march import begin, march
from tribo.simulation.positions import composed
from tribo.simulation.validity import doubting
from tribo.simulation.watch import Watch

OTHERS = (".csv", ".json", ".pdf", ".png", ".svg", ".toml", ".txt", ".xls", ".xlsx")
"""Endings of files that are not HDF5."""


class Simulation:
    """A composed case, ready to run.

    Parameters
    ----------
    case : Case, Mapping, str, Path or Model
        A case, one as plain data, a TOML file, or a case that is assembled.
    registry : Registry, optional
        Where to look classes up; the installed plugins if left out.

    Raises
    ------
    CaseError
        If the case is not valid or its parts do not fit together.

    Examples
    --------
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> result = tribo.Simulation(case).run()
    >>> f"1 µm is worn after {result.distances[-1]:.2f} m"
    '1 µm is worn after 1.32 m'
    """

    def __init__(
        self,
        case: Case | Mapping[str, Any] | str | Path | Model,
        registry: Registry | None = None,
    ) -> None:
        self._plugins: tuple[Plugin, ...] = ()
        if isinstance(case, Model):
            self.model = case
            return
        known = registry or default_registry()
        if not isinstance(case, Case):
            case = load_case(case, registry=known)
        # So that its result finds classes of one's own again.
        with suppress(CaseError):
            known.know_all(case)
        with doubting(case):
            self.model = composed(case)
        self._plugins = known.plugins

    def run(
        self,
        output: str | Path | None = None,
        *,
        observers: Sequence[Observer] = (),
        overwrite: bool = False,
    ) -> Result:
        """Run from the beginning.

        Parameters
        ----------
        output : str or Path, optional
            Result file to write; in memory if left out.
        observers : sequence of Observer, optional
            Watchers besides the observers of the case.
        overwrite : bool, optional
            Whether an existing file may be replaced.

        Returns
        -------
        Result
            The open result.

        Raises
        ------
        CaseError
            If the first contact does not fit the window, a time step is not
            stable, or the file exists.
        NumericalError
            If a solve or a step fails; what was saved stays.
        Interrupted
            If it was stopped from outside; it can be resumed.
        """
        path, state = _checked_output(output, overwrite), begin(self.model)
        return self._follow(state, Recorder(path=path), observers, resumed=False, wall_time=0.0)

    def resume(
        self,
        output: str | Path,
        *,
        observers: Sequence[Observer] = (),
        allow_changed: bool = False,
    ) -> Result:
        """Continue a run that was stopped, from its checkpoint.

        The result has the same bits as the result of an uninterrupted run.

        Parameters
        ----------
        output : str or Path
            The result file of the stopped run.
        observers : sequence of Observer, optional
            Watchers besides the observers of the case.
        allow_changed : bool, optional
            Whether to continue with a component of another class or version
            than in the stopped run; the result reports it.

        Raises
        ------
        CaseError
            If the file is not from a stopped run of this case, or a component
            has changed; and the errors of `run`.
        """
        path = Path(output)
        with Result.open(path) as result:
            status = result.status
            changes = self.changed_since(result)
            case = result.case_tables
        listed = "; ".join(f"{place} was {old}, is {new}" for place, old, new in changes)
        if status == "done":
            folder = RunFolder(path.resolve())
            if not folder.path.is_dir():
                told = f", with other components: {listed}" if changes else ""
                raise CaseError(
                    f"{path} is done{told}; there is nothing to resume; see it with: "
                    f"tribo show {path}"
                )
            # It was killed just as it ended.
            folder.lock()
            folder.remove()
            return Result.open(path)
        if changes and not allow_changed:
            raise CaseError(
                f"{path} was begun with other components: {listed}. Install those again, or go on "
                "with --allow-changed"
            )
        # Another version of a component may have other keys.
        if case != self.model.data and not changes:
            raise CaseError(f"{path} is the result of another case; resume that one")
        recorder = Recorder(path=path)
        state, wall_time = recorder.resume(case)
        state = state.without_findings("failed")
        return self._follow(state, recorder, observers, resumed=True, wall_time=wall_time)

    def changed_since(self, result: Result) -> list[tuple[str, str, str]]:
        """Return the place of each component that has changed since a result.

        With it, in words, the component then and now; the result that a run begins with counts too.
        """
        changes = changed_components(result.provenance, self._provenance())
        begun, begin = result.provenance.get("begun_with"), self.model.case.begin
        if begun and begin and os.path.exists(begin):
            was, is_now = begun["sha256"][:8], checksum(begin)[:8]
            if was != is_now:
                changes.append(
                    ("begin", f"a file of checksum {was}…", f"one of checksum {is_now}…")
                )
        return changes

    def _follow(
        self,
        state: State,
        recorder: Recorder,
        extra: Sequence[Observer],
        *,
        resumed: bool,
        wall_time: float,
    ) -> Result:
        audience = Audience((recorder, *self.model.case.observers, *extra))
        watch = Watch(self.model, extra)
        snapshot = watch.snapshot(state)
        info = self._info(snapshot if resumed else None, wall_time, watch)
        reason = "failed"
        try:
            with interrupts_held() as requested:
                audience.start(info)
                if not resumed:
                    _announce((), state.findings)
                    snapshot = with_effects(self.model, snapshot)
                    audience.step(snapshot, save=True)
                for accepted in march(self.model, state, watch):
                    _announce(snapshot.state.findings, accepted.state.findings)
                    snapshot = watch.snapshot(accepted.state)
                    if accepted.save:
                        snapshot = with_effects(self.model, snapshot)
                    audience.step(snapshot, save=accepted.save)
                    if requested.is_set() and not accepted.last:
                        raise KeyboardInterrupt
            reason = "done"
        except TriboError as error:
            # For whoever opens the result: it says why it ends here.
            snapshot = replace(snapshot, state=snapshot.state.with_findings(failed(error)))
            if recorder.holds:
                error.add_note(
                    f"{recorder.holds} holds what was saved until then; 'tribo run' replaces it "
                    "with --force (in Python overwrite=True)."
                )
            raise
        except KeyboardInterrupt as error:
            reason = "interrupted"
            where = recorder.path
            files = (each.distribution for each in self._plugins if each.origin == "file")
            option = "".join(f" --plugin {name}" for name in files)
            raise Interrupted(
                f"stopped at {snapshot.measures.time:.6g} s of {self.model.end_time:g} s"
                + (f"; go on with: tribo resume {where}{option}" if where else "")
            ) from error
        finally:
            if not snapshot.effects:
                # An effect that fails must not cost what the run came to.
                with suppress(TriboError):
                    snapshot = with_effects(self.model, snapshot)
            audience.finish(snapshot, reason)
        if requested.is_set():
            whole = f"; {recorder.path} has all of it" if recorder.path else ""
            raise Interrupted(f"stopped in the last step of a run{whole}")
        return recorder.result()

    def _provenance(self) -> dict[str, object]:
        """Return versions, the `origin` of each component by place, and the plugins found."""
        components = {place: Guard(c).ask(origin, c) for place, c in named(self.model.case)}
        plugins = [plugin.facts for plugin in self._plugins]
        return {**environment(), "components": components, "plugins": plugins}

    def _info(self, resumed_from: Snapshot | None, wall_time: float, watch: Watch) -> RunInfo:
        model, made = self.model, self._provenance()
        if model.case.begin is not None and resumed_from is None:
            begin = model.case.begin
            made["begun_with"] = {"result": begin, "sha256": checksum(begin)}
        return RunInfo(
            system=model.contact.system,
            bodies=tuple(
                BodyInfo(
                    name=name,
                    swept=name in model.cycle.swept,
                    density=body.material.density,
                    height=model.height(name),
                    rows=model.cycle.maps[name].rows,
                    state_fields=model.laws.kept_on(name),
                    straight=model.cycle.maps[name].across is None,
                )
                for name, body in model.case.bodies.items()
            ),
            end_time=model.end_time,
            end_distance=model.end_distance,
            case=model.data,
            provenance=made,
            effect_fields=tuple(f for effect in model.laws.effects for f in effect.provides),
            between_fields=model.laws.kept_on(None),
            columns=tuple(watch.columns.values()),
            resumed_from=resumed_from,
            wall_time=wall_time,
        )


def _announce(before: Sequence[Finding], after: Sequence[Finding]) -> None:
    for finding in after:
        if finding not in before and finding.is_warning:
            warn(str(finding))


def _checked_output(output: str | Path | None, overwrite: bool) -> Path | None:
    if output is None:
        return None
    path = Path(output)
    if path.suffix.lower() in OTHERS:
        raise CaseError(
            f"{path} would be an HDF5 file, which does not end in {path.suffix}; name it "
            f"{path.with_suffix('.h5')}, which 'tribo export' turns into CSV and 'tribo plot' into "
            "pictures"
        )
    remedy = (
        f"if its run was stopped, 'tribo resume {path}' continues it; choose another with -o, or "
        "replace it with --force (in Python overwrite=True)"
    )
    check_new(path, overwrite, remedy)
    return path
