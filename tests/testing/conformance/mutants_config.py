"""Wrong configurations, by the example of a wear law."""

from typing import Annotated

from pydantic import ConfigDict, field_validator, model_serializer
from testing.conformance.caught import caught_by
from testing.conformance.honest import Law

from tribo.plugin import Quantity


@caught_by("config_is_frozen")
class Thawed(Law):
    model_config = ConfigDict(frozen=False)


@caught_by("unknown_keys_are_refused")
class TakesAnything(Law):
    model_config = ConfigDict(extra="ignore")


@caught_by("quantities_have_units")
class WithoutUnit(Law):
    q: float = 3.0
    """Something."""


@caught_by("fields_are_described")
class Undescribed(Law):
    q: Annotated[float, Quantity("1")] = 3.0


@caught_by("config_survives_json")
class MillimetresEachTime(Law):
    q: Annotated[float, Quantity("m")] = 3.0
    """A length in mm."""

    @field_validator("q")
    @classmethod
    def _to_metres(cls, value):
        return 1e-3 * value


@caught_by("config_survives_without_defaults")
class DefaultsWithoutNeed(Law):
    q: Annotated[float, Quantity("1")] | None = None
    """Where it is left out it is not what its default says."""

    def model_post_init(self, context):
        if "q" not in self.model_fields_set:
            object.__setattr__(self, "q", 1.0)

    def model_dump(self, *, exclude_defaults=False, **options):
        dumped = super().model_dump(exclude_defaults=exclude_defaults, **options)
        return {**dumped, "q": None} if exclude_defaults else dumped


@caught_by("a_case_can_name_it")
class OfAnotherName(Law):
    type = "other.law"

    @model_serializer(mode="wrap")
    def _of_another_name(self, handler):
        return {**handler(self), "type": "other.name"}


@caught_by("name_has_a_prefix")
class WithoutPrefix(Law):
    type = "law"


def _local():
    class Unreachable(Law):
        """A class that no other process can find."""

    return Unreachable


caught_by("config_reaches_a_new_process")(_local())
