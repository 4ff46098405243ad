"""Wrong observers."""

from testing.conformance.caught import caught_by
from testing.conformance.honest import Counts


@caught_by("watching_changes_no_bit")
class Polishes(Counts):
    def on_step(self, snapshot):
        # Round the view, which is read-only.
        wear = snapshot.state.bodies["ball"].wear.base
        if wear is not None and wear.flags.writeable:
            wear *= 0.99


@caught_by("inputs_stay_as_they_are")
class WritesToSnapshots(Counts):
    def on_step(self, snapshot):
        snapshot.state.contact.pressure[0, 0] = 1.0


@caught_by("every_end_is_survived", AttributeError)
class NeedsASnapshot(Counts):
    def on_finish(self, snapshot, reason):
        self._steps = snapshot.state.bodies["ball"].wear.max()


@caught_by("resumed_run_is_survived", AssertionError)
class NeedsTheFirstStep(Counts):
    _first: object = None

    def on_step(self, snapshot):
        if snapshot.state.steps == 0:
            self._first = snapshot
        assert self._first is not None


@caught_by("second_run_is_survived", AssertionError)
class RunsOnce(Counts):
    _started: bool = False

    def on_start(self, run):
        assert not self._started
        self._started = True


@caught_by("nothing_is_printed")
class PrintsTheTime(Counts):
    def on_step(self, snapshot):
        print(snapshot.state.time)
