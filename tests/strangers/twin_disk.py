"""A stranger's motion: two disks that roll on each other with slip."""

from collections.abc import Mapping, Sequence
from typing import Annotated

from tribo import CaseError, Exposure, Grid, Kinematics, Quantity, Track, hookimpl

Length = Annotated[float, Quantity("m", above=0)]


class TwinDisk(Kinematics):
    """Slides |u1 − u2| t. In one pass a point slides |u1 − u2|/u_i per metre of contact, and it
    passes u_i/l_i times a second: per metre of sliding its share is dx/l_i, whatever the slip.
    """

    type = "stranger.twin_disk"
    speed: Annotated[float, Quantity("m/s", above=0)]
    """Mean of the two surface speeds."""
    slip: Annotated[float, Quantity("1", above=0, at_most=2)]
    """Difference of the surface speeds over their mean."""
    circumference: dict[str, Length]
    """Of each disk, by name."""
    duration: Annotated[float, Quantity("s", above=0)]
    """How long they run."""

    @property
    def end_time(self) -> float:
        return self.duration

    def distance_at(self, time: float) -> float:
        return self.slip * self.speed * time

    def time_at(self, distance: float) -> float:
        return distance / (self.slip * self.speed)

    def exposures(self, grid: Grid, bodies: Sequence[str]) -> Mapping[str, Exposure]:
        given = self.circumference
        if set(given) != set(bodies):
            raise CaseError(
                f"is given for {', '.join(given)}; the bodies are {', '.join(bodies)}",
                "kinematics.circumference",
            )
        # A disk turns: its points pass, its shape stays where it is.
        return {name: Track(grid, given[name], shape_stays=True) for name in bodies}


@hookimpl
def tribo_components() -> list[type[TwinDisk]]:
    return [TwinDisk]
