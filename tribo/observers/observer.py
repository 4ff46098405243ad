"""The interface of observers, which watch a run."""

from __future__ import annotations

from tribo.component import Component
from tribo.core.state import RunInfo, Snapshot


class Observer(Component):
    """Watches a run through read-only views, without influence on the answer.

    An exception that an observer raises stops the run; in `on_finish` it is
    only a warning where the run did not finish.

    Examples
    --------
    >>> class Bell(tribo.Observer):
    ...     def on_finish(self, snapshot, reason):
    ...         print(reason, "after", round(snapshot.measures.distance, 1), "m")
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse)
    >>> result = case.with_values({"observers": [Bell()]}).run()
    done after 1.3 m
    """

    def on_start(self, run: RunInfo) -> None:
        """Before the first contact is solved, or when a run is resumed."""

    def on_step(self, snapshot: Snapshot) -> None:
        """After each accepted step, and after the first contact."""

    def on_save(self, snapshot: Snapshot) -> None:
        """At t = 0, at each requested save time, and at the end."""

    def on_finish(self, snapshot: Snapshot | None, reason: str) -> None:
        """When the run ends: ``"done"``, ``"interrupted"`` or ``"failed"``.

        `snapshot` is the last accepted state, None if there is none.
        """
