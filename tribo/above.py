"""What models, cases and results call of the layers above them: the one place that imports upwards.

``case.run()``, a name given without a registry, ``result.report()``, ``result.plot()`` and a result
in a notebook are short for functions of higher layers, which are imported when first called. All
other imports go one way.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from tribo.case import Case
    from tribo.lab.report import LabReport
    from tribo.registry.registry import Registry
    from tribo.result.read import Result


def run(case: Case, output: str | Path | None, **options: Any) -> Result:
    """Run a case from the beginning."""
    from tribo.simulation.run import Simulation

    return Simulation(case).run(output, **options)


def installed() -> Registry:
    """Return the registry of the built-in and the installed plugins."""
    from tribo.registry.registry import default_registry

    return default_registry()


def report(result: Result) -> LabReport:
    """Return what a laboratory would measure of a result."""
    from tribo.lab.report import lab_report

    return lab_report(result)


def plot(result: Result, folder: Path, suffix: str) -> list[Path]:
    """Write every picture that makes sense for a result."""
    from tribo.plotting.figures import save_figures

    return save_figures(result, folder, suffix)


def html(result: Result) -> str:
    """Return the lab table of a result and a picture of its pressure, for a notebook."""
    from tribo.cli.notebook import html as shown

    return shown(result)
