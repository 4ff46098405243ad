"""What every call of a component must fulfil, whatever it computes."""

from __future__ import annotations

import io
import random
from collections.abc import Callable, Mapping
from contextlib import redirect_stdout
from copy import deepcopy
from dataclasses import dataclass
from typing import Any

import numpy as np

from tribo.testing.compare import arrays_in, first_difference
from tribo.testing.subject import Check, CheckFailed, Subject, fact, require


@dataclass(frozen=True)
class Exercise:
    """How the components of a kind are called.

    Parameters
    ----------
    inputs : callable
        Returns new inputs for a subject and a component; those of number 0
        and 1 differ.
    call : callable
        Calls the component with them and returns its answers by name.
    """

    inputs: Callable[[Subject, Any, int], Any]
    call: Callable[[Any, Any], Mapping[str, Any]]

    def answers(self, subject: Subject, component: Any, number: int = 0) -> Mapping[str, Any]:
        """Return the answers to read-only inputs."""
        return self.call(component, locked(self.inputs(subject, component, number)))


def locked(value: Any) -> Any:
    """Make all arrays in `value` read-only, and return it."""
    for _, array in arrays_in(value):
        array.flags.writeable = False
    return value


def call_checks(exercise: Exercise) -> tuple[Check, ...]:
    """Return the checks of purity for one kind of component."""

    @fact
    def read_only_inputs_are_accepted(subject: Subject) -> None:
        """Arrays that cannot be written to are good enough as inputs."""
        try:
            exercise.answers(subject, subject.make())
        except ValueError as error:
            if "read-only" in str(error):
                raise CheckFailed(f"it asks for writable arrays or writes to them: {error}") from (
                    error
                )
            raise

    @fact
    def inputs_stay_as_they_are(subject: Subject) -> None:
        """No input is changed by a call."""
        component = subject.make()
        inputs = exercise.inputs(subject, component, 0)
        before = deepcopy(inputs)
        exercise.call(component, inputs)
        where = first_difference(before, inputs)
        require(where is None, f"{where} was changed; work on a copy")

    @fact
    def same_inputs_give_same_bits(subject: Subject) -> None:
        """The answer follows from the inputs alone, whatever was asked before."""
        component = subject.make()
        first = deepcopy(exercise.answers(subject, component))
        for when in ("asked again", "asked after other inputs", "asked of a new object"):
            if when == "asked after other inputs":
                exercise.answers(subject, component, 1)
            elif when == "asked of a new object":
                component = subject.make()
            where = first_difference(first, exercise.answers(subject, component))
            require(where is None, f"{where} differs when {when}; keep nothing that evolves")

    @fact
    def answers_may_be_overwritten(subject: Subject) -> None:
        """What a caller does to an answer does not show in the next one."""
        component = subject.make()
        first = exercise.answers(subject, component)
        kept = deepcopy(first)
        for _, array in arrays_in(first):
            if array.flags.writeable:
                array.fill(-1.0)
        where = first_difference(kept, exercise.answers(subject, component))
        require(
            where is None,
            f"{where} changed with an earlier answer: the component gave away its own array; "
            "return a copy",
        )

    @fact
    def nothing_is_printed(subject: Subject) -> None:
        """Standard output is left to the command line."""
        caught = io.StringIO()
        with redirect_stdout(caught):
            exercise.answers(subject, subject.make())
        said = caught.getvalue()
        require(not said, f"it printed {said[:60]!r}; leave it out, or use sys.stderr or logging")

    @fact
    def no_global_random_numbers(subject: Subject) -> None:
        """Random numbers come from a generator of its own, with a seed in its configuration."""
        component = subject.make()
        before = _generators()
        exercise.answers(subject, component)
        after = _generators()
        for number, module in enumerate(("random", "numpy.random")):
            require(
                first_difference(before[number], after[number]) is None,
                f"it drew from the global generator of {module}; use numpy.random.default_rng "
                "with a seed from the configuration",
            )

    return (
        read_only_inputs_are_accepted,
        inputs_stay_as_they_are,
        same_inputs_give_same_bits,
        answers_may_be_overwritten,
        nothing_is_printed,
        no_global_random_numbers,
    )


def _generators() -> tuple[Any, Any]:
    state: Any = np.random.get_state
    return random.getstate(), deepcopy(state())
