"""Numbers that are read off a run: their names and units."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass


def labelled(name: str, unit: str) -> str:
    """Return a name with its unit, as ``max_pressure_Pa`` or ``dissipated_energy_J_m2``."""
    suffix = re.sub(r"\W+", "_", unit.replace("^", ""))
    return name if unit == "1" else f"{name}_{suffix}"


@dataclass(frozen=True)
class Column:
    """The declaration of a number: what it means, in which unit, and how it is read.

    Parameters
    ----------
    name : str
        Letters, digits and underscores: part of the names of columns in tables and files.
    unit : str
        Its SI unit; ``"1"`` for none.
    description : str
        What it means.
    read : callable
        Returns it as a float, NaN where there is none. What it is given is a `Snapshot` where a
        model has the column among its `columns`, a `Result` where a package has it among its
        quantities.
    of_bodies : bool, optional
        Whether each body has one: `read` is given the name of a body too.

    Examples
    --------
    >>> mean = tribo.Column(
    ...     "mean_pressure", "Pa", "load over area", lambda at: at.measures.load / at.measures.area
    ... )
    >>> mean.label
    'mean_pressure_Pa'
    """

    name: str
    unit: str
    description: str
    read: Callable[..., float]
    of_bodies: bool = False

    @property
    def label(self) -> str:
        """Name with the unit, as in JSON and CSV: ``max_pressure_Pa``."""
        return labelled(self.name, self.unit)
