"""The data of one body in a result."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from tribo.core.arrays import Array
from tribo.core.errors import CaseError


@dataclass(frozen=True)
class BodyResult:
    """The data of one body in a result.

    Parameters
    ----------
    name : str
        Its name.
    swept : bool
        Whether its points passed through the contact.
    straight : bool
        Whether they did so along x alone, if they did.
    density : float or None
        In kg/m³.
    height : ndarray, shape (nx, ny)
        Its initial height outward, in m.
    wear_depth, plastic_depth : ndarray, shape (saves, nx, ny)
        At each save, in m. On a swept body the wear does not vary along x.
    state : Mapping[str, ndarray]
        What its wear law keeps per material point, by name, shaped as
        `wear_depth`.
    effects : Mapping[str, ndarray]
        What the effects provided at each save, such as a temperature, by
        name, shape (saves, nx, ny). NaN where an effect failed.

    Examples
    --------
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> result = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse).run()
    >>> ball = result.body("ball")
    >>> (1e6 * ball.wear_depth.max(axis=(1, 2))).round(2).tolist()  # µm at each saved time
    [0.0, 1.0]
    """

    name: str
    swept: bool
    straight: bool
    density: float | None
    height: Array
    wear_depth: Array
    plastic_depth: Array
    state: Mapping[str, Array] = field(default_factory=dict)
    effects: Mapping[str, Array] = field(default_factory=dict)

    def surface(self, save: int) -> Array:
        """Return the height outward at a save, worn and deformed, in m.

        Raises
        ------
        CaseError
            If there is no such save.
        """
        save = checked_save(save, len(self.wear_depth), f"body {self.name!r}")
        surface: Array = self.height - self.wear_depth[save] - self.plastic_depth[save]
        return surface


def checked_save(save: int, count: int, who: str) -> int:
    """Return `save`; CaseError if `who` has none of that number."""
    if not -count <= save < count:
        raise CaseError(f"{who} has no save {save}; it has {count}, counted from 0")
    return save
