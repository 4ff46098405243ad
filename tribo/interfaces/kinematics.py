"""How far has it slid at time t, and which points of which body see the contact?"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence

from tribo.core.grid import Grid
from tribo.interfaces.component import C_co, Component, ComponentConfig
from tribo.interfaces.exposure import Exposure


class KinematicsConfig(ComponentConfig):
    """Base configuration of a motion."""


class Kinematics(Component[C_co]):
    """A sliding motion along x."""

    @property
    @abstractmethod
    def duration(self) -> float:
        """Time at which the motion ends, in s."""

    @abstractmethod
    def distance(self, time: float) -> float:
        """Return the path slid from 0 to `time` (s), in m; never decreasing."""

    @abstractmethod
    def time(self, distance: float) -> float:
        """Return the time at which the path reaches `distance` (m), in s."""

    def speeds(self) -> Sequence[tuple[float, float]] | None:
        """Return the sliding speeds of a cycle, each with its share of the path.

        Effects and wear laws are asked at each of these speeds, and their rates
        averaged over the path, however long a step is.

        Returns
        -------
        sequence of (float, float) or None
            Speeds in m/s, and shares that add up to 1. None, unless overridden:
            then they are asked at the mean speed over each step.
        """
        return None

    @abstractmethod
    def exposures(self, grid: Grid, bodies: Sequence[str]) -> Mapping[str, Exposure]:
        """Return how each body, by name, meets the contact.

        Parameters
        ----------
        grid : Grid
            The window.
        bodies : sequence of str
            Names of the bodies, in the order of the case.

        Raises
        ------
        CaseError
            If the motion names a body that the case does not have.
        """

    def limitation(self, grid: Grid, half_width_x: float) -> str | None:
        """Return why the motion's averaging no longer holds, or None while it does.

        Parameters
        ----------
        grid : Grid
            The window; its spacing is the accuracy of `half_width_x`.
        half_width_x : float
            Half the extent of the contact along x, in m.
        """
        return None

    def track_limitation(
        self,
        grid: Grid,
        half_width_x: float,
        depth: float,
        approach: float,
        volume_ratio: float,
    ) -> str | None:
        """Return why the averaging does not hold for a track worn so deep; `limitation` if left.

        Parameters
        ----------
        grid : Grid
            The window.
        half_width_x : float
            Half the extent of the contact along x, in m.
        depth : float
            Largest worn depth of a swept body, in m.
        approach : float
            Elastic approach of the first contact, in m.
        volume_ratio : float
            Volume lost by the bodies that stay over that lost by the swept ones.
        """
        return self.limitation(grid, half_width_x)

    def check_contact(self, half_width_x: float) -> None:
        """Raise `CaseError` if a first contact of this half-width makes the averaging absurd."""
