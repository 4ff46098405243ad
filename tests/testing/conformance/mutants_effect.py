"""Wrong effects."""

import numpy as np
from testing.conformance.caught import caught_by
from testing.conformance.honest import Traction

from tribo.core.errors import PluginError
from tribo.plugin import Field


@caught_by("provided_fields_are_declared")
class WithoutUnits(Traction):
    provides = (Field("traction", "", "Friction force per area."),)


@caught_by("every_declared_field_is_answered")
class OneBodyOnly(Traction):
    def fields(self, contact):
        answers = super().fields(contact)
        first = next(iter(contact.materials))
        return {"traction": {first: answers["traction"][first]}}


@caught_by("every_declared_field_is_answered")
class NotFinite(Traction):
    def fields(self, contact):
        answers = super().fields(contact)
        return {"traction": {name: np.log(-v - 1) for name, v in answers["traction"].items()}}


@caught_by("bodies_may_have_any_names")
class KnowsTheBall(Traction):
    def fields(self, contact):
        values = super().fields(contact)["traction"]
        return {"traction": {n: 0.1 * v if n == "ball" else v for n, v in values.items()}}


@caught_by("only_declared_fields_are_asked_for")
class RequiresNothing(Traction):
    requires = ()


@caught_by("inputs_stay_as_they_are")
class HeatsTheContact(Traction):
    def fields(self, contact):
        if contact.pressure.flags.writeable:
            contact.pressure[:] *= 1.1
        return super().fields(contact)


@caught_by("runs_in_a_case", PluginError)
class FailsLater(Traction):
    def fields(self, contact):
        if contact.distance < 0.99:
            raise RuntimeError("too early")
        return super().fields(contact)
