"""Whether local fields are declared as they should be."""

from __future__ import annotations

from collections.abc import Iterable

from tribo.core.dimensions import scale
from tribo.core.fields import Field, name_fault
from tribo.testing.subject import CheckFailed, require


def expect_declared(where: str, fields: Iterable[Field]) -> None:
    """Fail unless each field has its own name, a unit that can be read and a description."""
    fields = tuple(fields)
    for field in fields:
        require(isinstance(field, Field), f"{where} holds {field!r}; a Field is needed")
    fault = name_fault(fields)
    require(not fault, f"{where}: {fault}")
    for field in fields:
        require(field.description.strip(), f"{where}: {field.name!r} has no description")
        try:
            size, _ = scale(field.unit)
        except ValueError as error:
            raise CheckFailed(
                f"{where}: the unit {field.unit!r} of {field.name!r} cannot be read ({error}); "
                "use an SI unit, '1' for none"
            ) from error
        require(size == 1, f"{where}: the unit {field.unit!r} of {field.name!r} is not SI")
