"""What every effect must fulfil."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from tribo.core.fields import ContactConditions, LocalConditions, WearRate
from tribo.simulation.guards import GuardedEffect
from tribo.testing import samples
from tribo.testing.checks import Checks
from tribo.testing.compare import first_difference, locked, require
from tribo.wear.law import WearLaw


class EffectChecks(Checks):
    """Checks of an effect."""

    def _inputs(self, component: Any, number: int) -> ContactConditions:
        conditions = samples.contact_conditions(component, self._fields)
        if number == 0:
            return conditions
        return replace(conditions, pressure=0.5 * conditions.pressure, time=20.0, distance=2.0)

    def _call(self, component: Any, inputs: Any) -> Mapping[str, Any]:
        return {name: dict(values) for name, values in component.fields(inputs).items()}

    def answers_fit_a_run(self) -> None:
        """Each declared field comes for each body, finite, within its limits, on the window."""
        effect = self._make()
        for number in (0, 1):
            GuardedEffect(effect).fields(locked(self._inputs(effect, number)))

    def bodies_may_have_any_names(self) -> None:
        """Nothing depends on what the bodies are called."""
        effect = self._make()
        usual = self._answers(effect)
        names = ("upper", "lower")
        given = locked(samples.contact_conditions(effect, self._fields, names))
        renamed = self._call(effect, given)
        for field in effect.provides:
            for name, before in zip(names, samples.BODIES, strict=True):
                changed = first_difference(renamed[field.name][name], usual[field.name][before])
                require(not changed, f"{field.name!r} changes when {before!r} is called {name!r}")

    def only_declared_fields_are_asked_for(self) -> None:
        """It asks for no field but those in `requires`."""
        effect = self._make()
        conditions = locked(self._inputs(effect, 0))
        fields = samples.Asked(conditions.fields)
        try:
            effect.fields(replace(conditions, fields=fields))
        except KeyError:
            if not fields.missed:
                raise
        missed = ", ".join(sorted(map(str, fields.missed)))
        require(not missed, f"it asked for the field {missed}; add that to requires")

    def runs_in_a_case(self) -> None:
        """In a small case a law gets the fields it requires in every step."""
        effect = self._make()
        law = _reads([field.name for field in effect.provides])
        samples.run(self._fields, law=law, effects=[effect])


def _reads(names: Sequence[str]) -> WearLaw:
    """Return a law that requires some fields and wears as if they were not there."""

    class Reads(WearLaw):
        type = "tribo.testing.reads"
        requires = tuple(names)

        def rate(self, local: LocalConditions) -> WearRate:
            return samples.ARCHARD.rate(local)

    return Reads()
