"""Wear in particles, each of which holds for a random while."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Self

from pydantic import Field as Bounded
from pydantic import model_validator
from tribo import Archard, CaseError, Field, LocalConditions, Quantity, WearLaw, WearRate

from tribo_roughening.resistance import resistance

CELLS = 4
"""Cells that a particle must have, as many as a wave of a rough surface."""
WORN = Field("worn", "m", "Depth worn so far, by which a point knows its particle.")


class Detachment(WearLaw):
    """dh/ds = k p / R, with R the wear resistance of the particle that is at the surface.

    The material is made of particles of a diameter d and a thickness t. R is drawn for each, with
    mean 1, from a gamma distribution; in between it is linear (`resistance`). With a spread of 1 it
    is exponential: the chance of a particle to leave is the same in every metre, as Archard takes
    it. A point under an even pressure wears by k p on average, and so does a whole contact once
    the pressure has spread itself in proportion to R (Khrushchov: the wear resistance of a
    composite is the mean of its parts').

    Particles that hold on stand out until they carry the load that wears them, so that a surface
    keeps a roughness that does not depend on its first one. Valid where particles are small beside
    the contact, thin beside the depth worn, and at least four cells wide.

    References
    ----------
    Archard, J. F. (1953), Contact and rubbing of flat surfaces, J. Appl. Phys. 24, 981-988.
    Khrushchov, M. M. (1974), Principles of abrasive wear, Wear 28, 69-88. Sugimura, J., Kimura, Y.
    (1984), Characterization of topographical changes during lubricated wear, Wear 98, 101-116.

    Examples
    --------
    >>> from tribo_roughening.detachment import Detachment
    >>> law = Detachment(k="3e-16 1/Pa", diameter="10 um", thickness="0.5 um")
    >>> print(law.facts()["particles"])
    10 µm wide, 0.5 µm thick, a spread of 0.5
    """

    examples = ({"k": "3.11e-16 1/Pa", "diameter": "0.2 mm", "thickness": "0.5 um"},)
    type = "roughening.detachment"
    k: Annotated[float, Quantity("1/Pa", at_least=0, usual=(1e-22, 1e-10))]
    """Mean specific wear rate, volume per load and sliding distance."""
    diameter: Annotated[float, Quantity("m", above=0, usual=(1e-9, 1e-3))]
    """Diameter d of a particle along the surface."""
    thickness: Annotated[float, Quantity("m", above=0, usual=(1e-10, 1e-4))]
    """Thickness t of a particle."""
    spread: Annotated[float, Quantity("1", above=0, at_most=1)] = 0.5
    """Standard deviation of the particles' resistance, relative to its mean."""
    period: Annotated[float, Quantity("m", above=0)] | None = None
    """Length after which the particles repeat along x and y, as a periodic window does."""
    seed: Annotated[int, Bounded(ge=0)] = 0
    """Seed of the draws."""

    requires = ("place_x", "place_y")
    state_fields = (WORN,)

    @model_validator(mode="after")
    def _whole_particles(self) -> Self:
        if self.period is not None:
            count = self.period / self.diameter
            if round(count) < 1 or abs(count - round(count)) > 1e-6 * count:
                raise ValueError("period must be a whole number of diameters")
        return self

    def check_cells(self, spacing: tuple[float, float]) -> None:
        """Require four cells for a particle, so that finer ones find the same roughness."""
        width, cell = self.diameter, max(spacing)
        if width < CELLS * cell * (1 - 1e-9):
            raise CaseError(
                f"particles of {1e6 * width:.4g} µm are {width / cell:.2g} cells of "
                f"{1e6 * cell:.4g} µm, and {CELLS} at least are needed; raise grid.cells, or give "
                "a larger diameter"
            )

    def smoothed(self) -> WearLaw:
        """Return Archard's law with the same k, which it follows on average."""
        return Archard(k=self.k)

    def facts(self) -> Mapping[str, str]:
        """Return its particles, and whether they repeat."""
        wide, thick = f"{1e6 * self.diameter:.4g}", f"{1e6 * self.thickness:.4g}"
        again = "none; a window that repeats needs one as long as itself"
        if self.period is not None:
            again = f"{1e6 * self.period:.4g} µm"
        return {
            "particles": f"{wide} µm wide, {thick} µm thick, a spread of {self.spread:g}",
            "their draws": f"seed {self.seed}; a body of the same seed has the same particles",
            "their period": again,
        }

    def rate(self, local: LocalConditions) -> WearRate:
        """Return k p / R and k / R; the depth worn is a state of the law."""
        held = resistance(
            local.fields["place_x"],
            local.fields["place_y"],
            local.state[WORN.name],
            diameter=self.diameter,
            thickness=self.thickness,
            spread=self.spread,
            seed=self.seed,
            repeats=None if self.period is None else round(self.period / self.diameter),
        )
        slope = self.k / held
        depth = slope * local.pressure
        return WearRate(depth, slope, {WORN.name: depth})
