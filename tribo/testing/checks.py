"""The contract of components of every kind."""

from __future__ import annotations

import io
import pickle
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import redirect_stdout
from copy import deepcopy
from importlib.util import find_spec
from inspect import isclass
from typing import Any, ClassVar

import numpy as np
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from tribo.component import Component, components
from tribo.contract import answers_of
from tribo.core.fields import Field
from tribo.core.table import descriptions
from tribo.core.units import parts, quantities
from tribo.testing.compare import (
    expect_close,
    first_difference,
    locked,
    mapped,
    renamed,
    require,
    values_in,
)
from tribo.testing.process import process_restored, process_state
from tribo.testing.rescaling import UNITS, in_other_units, rescaled, units_of

BODIES = ("ball", "disk")
"""Names of the bodies that components are tried with."""
OTHER_NAMES = ("upper", "lower")


def needed_by(*models: object) -> list[Field]:
    """Return the properties of materials that components, and components within, need."""
    outer = [("", model) for model in models if isinstance(model, Component)]
    inner = [pair for _, model in outer for pair in components(model)]
    return [field for _, model in (*outer, *inner) for field in model.material_properties]


class Checks(ABC):
    """The checks of one configuration of a class: each public method is one.

    Its docstring states the fact that must hold. It returns if it does, raises
    `CheckFailed` or what the component raises if it does not, and
    `NotApplicable` where there is nothing to check.

    Parameters
    ----------
    config : Component
        The configuration.
    configs : sequence of Component, optional
        All configurations that are checked: some facts need hold in one of them only.
    """

    _numbers: ClassVar[Sequence[int]] = (0, 1)
    """Of the inputs that it is asked."""
    _exactness: ClassVar[float] = 1e-9
    """Part of an answer by which it may differ in other units."""

    def __init__(self, config: Any, configs: Sequence[Any] = ()) -> None:
        self._cls: Any = type(config)
        self._config = config
        self._configs = configs
        self._bodies = BODIES
        self._kept: dict[int, Any] = {}

    @abstractmethod
    def _inputs(self, component: Any, number: int) -> Any:
        """Return inputs for a call, by number."""

    @abstractmethod
    def _call(self, component: Any, inputs: Any) -> Mapping[str, Any]:
        """Call the component with inputs, and return its answers by name."""

    def _units(self, component: Any) -> Mapping[str, float]:
        """Return by what inputs and answers are multiplied in the other units, by their names."""
        needed = {field.name: field for field in needed_by(component)}
        return {**UNITS, **units_of(needed), **units_of(answers_of(component))}

    def _make(self) -> Any:
        """Return a new component with the configuration."""
        return self._cls.model_validate(self._config.model_dump())

    def _sample(self, number: int = 0) -> Any:
        """Return the inputs of a number, which cannot be written to."""
        if number not in self._kept:
            with process_restored():
                self._kept[number] = locked(self._inputs(self._make(), number))
        return self._kept[number]

    def _samples(self) -> list[Any]:
        return [self._sample(number) for number in self._numbers]

    def objects_are_frozen_and_know_their_keys(self) -> None:
        """An object cannot be changed, and a key that it does not have is an error."""
        for option, needed in (("frozen", True), ("extra", "forbid")):
            given = self._cls.model_config.get(option)
            require(given == needed, f"model_config has {option}={given!r}; keep {needed!r}")

    def configuration_is_described(self) -> None:
        """Each field of the configuration has a description, and each real number its unit."""
        keys = list(_keys(self._cls))
        silent = [name for name, text, _ in keys if not text]
        require(not silent, f"{', '.join(silent)}: no description; put a docstring under the field")
        bare = [n for n, _, f in keys if float in parts(f) and not any(quantities(f))]
        require(
            not bare,
            f"{', '.join(bare)}: no unit; declare it as Annotated[float, Quantity('Pa')], "
            "Quantity('1') for none",
        )

    def configuration_survives_a_file(self) -> None:
        """Written to a file, with or without its defaults, or pickled, and read, it is the same."""
        config, module = self._config, self._cls.__module__
        read = self._cls.model_validate_json
        ways: dict[str, Callable[[], Any]] = {
            "as JSON": lambda: read(config.model_dump_json()),
            "without its defaults": lambda: read(config.model_dump_json(exclude_defaults=True)),
        }
        if module != "__main__":
            # As parallel sweeps send it; a module that is not found is a ValueError.
            ways["pickled"] = lambda: find_spec(module) and pickle.loads(pickle.dumps(config))
        for how, again in ways.items():
            found = again()
            require(found == config, f"written {how} and read back, {config!r} is {found!r}")

    def calls_leave_no_trace(self) -> None:
        """A call prints nothing, and changes neither its inputs nor the state of the process.

        That is: global random numbers, numpy's treatment of errors, filters of warnings, the
        working folder and the environment.
        """
        for given in map(deepcopy, self._samples()):
            before = deepcopy({"inputs": given, **process_state()})
            with redirect_stdout(io.StringIO()) as printed:
                self._call(self._make(), given)
            where = first_difference(before, {"inputs": given, **process_state()})
            require(where is None, f"{where} was changed")
            said = printed.getvalue()
            require(not said, f"it printed {said[:60]!r}; leave it out, or use logging")

    def same_inputs_give_same_bits(self) -> None:
        """The answer follows from the inputs alone, whatever was asked before; so do its facts."""
        used, answers = self._make(), []
        stated, later = (used.facts() for _ in range(2))
        text = all(isinstance(word, str) for fact in stated.items() for word in fact)
        require(text, f"facts() gave {stated}; give text by text")
        require(later == stated, f"facts() gave {stated}, and then {later}")
        for given in self._samples():
            first = deepcopy(self._call(self._make(), given))
            answers.append((first, self._call(used, given)))
            for when, component in (
                ("an object was called with other inputs before", used),
                ("called again", used),
                ("called on a new object", self._make()),
            ):
                where = first_difference(first, self._call(component, given))
                require(where is None, f"{where} differs when {when}; keep nothing that evolves")
        for first, answer in answers:
            for where, value in values_in(answer).items():
                kind = getattr(value, "dtype", None)
                exact = kind not in (np.float16, np.float32)
                require(exact, f"{where} is in {kind}; answer in double precision")
            where = first_difference(first, answer)
            require(where is None, f"{where}, an answer, was changed as others were asked for")

    def bodies_may_have_any_names(self) -> None:
        """Nothing depends on names and order of the bodies but by what its configuration names."""
        data = renamed(self._config.model_dump(), BODIES, OTHER_NAMES)
        others = type(self)(self._cls.model_validate(data))
        others._bodies = OTHER_NAMES
        for given, named in zip(self._samples(), others._samples(), strict=True):
            usual = renamed(self._call(self._make(), given), BODIES, OTHER_NAMES)
            for name, other in zip(BODIES, OTHER_NAMES, strict=True):
                # A state may have the name of a body in its own.
                usual = {key.replace(name, other): answer for key, answer in usual.items()}
            for how, asked in (
                (f"are called {OTHER_NAMES}", named),
                ("change places", locked(mapped(named, lambda _, value: value, order=reversed))),
            ):
                where = first_difference(others._call(others._make(), asked), usual)
                require(where is None, f"{where} changes when the bodies {how}")

    def units_may_be_rescaled(self) -> None:
        """In other units of length, mass, time and temperature it answers the same."""
        component, other = self._make(), rescaled(self._config)
        units = self._units(component)
        for given in self._samples():
            answer = in_other_units(deepcopy(self._call(component, given)), units)
            found = self._call(other, locked(in_other_units(given, units)))
            expect_close(
                "in other units (a number in the code has a unit, or the answer has another unit "
                "than declared)",
                found,
                answer,
                self._exactness,
            )


def _keys(table: type[BaseModel], place: str = "") -> Iterator[tuple[str, str | None, FieldInfo]]:
    """Yield every key of a table, and of tables inside, with its description and field."""
    texts = descriptions(table)
    for name, field in table.model_fields.items():
        yield f"{place}{name}", texts.get(name), field
        inside = (part for part in parts(field) if isclass(part) and issubclass(part, BaseModel))
        for part in inside:
            if not issubclass(part, Component):
                yield from _keys(part, f"{place}{name}.")
