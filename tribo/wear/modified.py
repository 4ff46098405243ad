"""Laws made from another law: their base, and the simplest, a factor."""

from __future__ import annotations

from typing import Annotated, ClassVar, Self

from pydantic import model_validator

from tribo.core.arrays import Array
from tribo.core.fields import WORN_DEPTH, Field, LocalConditions, WearRate, check_declared
from tribo.core.material import Material
from tribo.core.units import Quantity
from tribo.wear.law import WearLaw


class ModifiedLaw(WearLaw):
    """A law that changes the rate of another law.

    It requires the fields that `law` requires, keeps the states of `law` beside its own, and is
    refused where `law` is. A subclass writes `rate`; ``self.law.rate(local)`` is the other rate.

    Examples
    --------
    >>> from dataclasses import replace
    >>> class Lubricated(tribo.ModifiedLaw):
    ...     def rate(self, local):
    ...         rate = self.law.rate(replace(local, pressure=0.8 * local.pressure))
    ...         return replace(rate, depth_slope=None)
    >>> local = tribo.LocalConditions(np.array([1e9]), 0.1, tribo.Material(name="100Cr6"))
    >>> law = Lubricated(law=tribo.Archard(k="1e-15 1/Pa"))
    >>> law.rate(local).depth_rate.round(9).tolist()  # 0.8 µm a metre in place of 1 µm
    [8e-07]
    """

    law: WearLaw
    """The law that it changes."""

    own_requires: ClassVar[tuple[str | Field, ...]] = ()
    """Names of the local fields that it needs itself."""

    own_state: ClassVar[tuple[Field, ...]] = ()
    """Fields that it keeps itself per material point."""

    @model_validator(mode="after")
    def _distinct_fields(self) -> Self:
        try:
            check_declared(self, f"{self.type!r} on {self.law.type!r}")
        except TypeError as error:
            raise ValueError(str(error)) from None
        return self

    @property
    def requires(self) -> tuple[str | Field, ...]:  # type: ignore[override]
        """The fields that either requires."""
        return tuple(dict.fromkeys((*self.law.requires, *self.own_requires)))

    @property
    def state_fields(self) -> tuple[Field, ...]:  # type: ignore[override]
        """The states of either."""
        return (*self.law.state_fields, *self.own_state)

    def check(self, material: Material) -> None:
        """Ask the other law; see `WearLaw.check`."""
        self.law.check(material)

    def check_cells(self, spacing: tuple[float, float]) -> None:
        """Ask the other law; see `WearLaw.check_cells`."""
        self.law.check_cells(spacing)

    def smoothed(self) -> WearLaw:
        """Return the law of the smoothed other law."""
        return self.model_copy(update={"law": self.law.smoothed()})

    def initial_state(self) -> dict[str, float]:
        """Return the initial values of the other law's states, and zero for its own."""
        return {**self.law.initial_state(), **{field.name: 0.0 for field in self.own_state}}


def times(factor: float | Array, rate: WearRate) -> WearRate:
    """Return a rate with its depth and derivative times a factor; rates of states stay."""
    slope, depth = rate.depth_slope, factor * rate.depth_rate
    changes = rate.state_rates
    if WORN_DEPTH.name in changes:
        changes = {**changes, WORN_DEPTH.name: depth}
    return WearRate(depth, None if slope is None else factor * slope, changes)


class Scaled(ModifiedLaw):
    """dh/ds = f r(p), with r another law: any law, times a factor.

    Valid where r is; the factor is a fit, for a lubricant, a coating or another test.

    Examples
    --------
    >>> local = tribo.LocalConditions(np.array([1e9]), 0.1, tribo.Material(name="100Cr6"))
    >>> oiled = tribo.Scaled(factor=0.2, law=tribo.Archard(k="1e-15 1/Pa"))
    >>> oiled.rate(local).depth_rate.round(9).tolist()  # 0.2 µm a metre in place of 1 µm
    [2e-07]
    """

    examples = ({"factor": 0.2, "law": {"type": "archard", "k": "3.11e-16 1/Pa"}},)
    type = "scaled"
    factor: Annotated[float, Quantity("1", at_least=0)]
    """The factor f."""

    def rate(self, local: LocalConditions) -> WearRate:
        """Return the other law's rate and derivative, times the factor."""
        return times(self.factor, self.law.rate(local))
