"""What ``case.run()``, ``result.report()`` and other shorthands of lower layers do.

The package binds them as it is imported; the functions that they call are imported when first
called.
"""

from tribo.core import shorthand

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path
    from typing import Any

    import pandas as pd
    from matplotlib.figure import Figure

    from tribo.case import Case
    from tribo.lab.report import LabReport
    from tribo.plotting.figures import Plot
    from tribo.registry.registry import Registry
    from tribo.result.read import Result
    from tribo.study.check import Check


def bind() -> None:
    """Give each shorthand its function."""
    shorthand.run = run
    shorthand.check = check
    shorthand.registry = registry
    shorthand.materials = materials
    shorthand.case = case
    shorthand.changed = changed
    shorthand.show = show
    shorthand.report = report
    shorthand.plot = plot
    shorthand.picture = picture
    shorthand.html = html
    shorthand.dataframe = dataframe


def run(
    case: "Case", output: "str | Path | None", progress: bool = False, **options: "Any"
) -> "Result":
    """Run a case from the beginning, with a bar if there is to be one."""
    from tribo.simulation.run import Simulation

    if progress:
        from tribo.observers.progress import Progress

        options["observers"] = [*options.get("observers", ()), Progress()]
    return Simulation(case).run(output, **options)


def check(case: "Case") -> "Check":
    """Predict what a case will do."""
    from tribo.study.check import check_case

    return check_case(case)


def case(tables: "dict[str, Any]") -> "Case":
    """Return the case that tables are of."""
    from tribo.config.load import validate_case

    return validate_case(tables)


def changed(case: "Case", settings: "Mapping[str, Any]") -> "Case":
    """Return a case with some values, by path, replaced."""
    from tribo.config.load import case_tables, validate_case
    from tribo.config.overrides import apply_settings

    return validate_case(apply_settings(case_tables(case), settings))


def show(result: "Result") -> None:
    """Print a result as the terminal does."""
    from tribo.cli.lab_report import print_report

    print_report(result)


def registry() -> "Registry":
    """Return the registry of the built-in and the installed plugins."""
    from tribo.registry.registry import default_registry

    return default_registry()


def materials() -> "list[Path]":
    """Return the files ``materials.toml`` of installed packages, none of which is imported."""
    from importlib.util import find_spec
    from pathlib import Path

    usable = (p for p in registry().plugins if p.usable and p.origin == "installed")
    specs = map(find_spec, sorted({plugin.entry_point.partition(".")[0] for plugin in usable}))
    files = (
        Path(spec.origin).with_name("materials.toml") for spec in specs if spec and spec.origin
    )
    return [file for file in files if file.is_file()]


def report(result: "Result") -> "LabReport":
    """Return what a laboratory would measure of a result."""
    from tribo.lab.report import lab_report

    return lab_report(result)


def plot(result: "Result") -> "Plot":
    """Return the pictures of a result."""
    from tribo.plotting.figures import Plot

    return Plot(result)


def picture(result: "Result", name: str) -> "Figure":
    """Draw one picture of a result."""
    from tribo.plotting.figures import result_picture

    return result_picture(result, name)


def html(result: "Result") -> str:
    """Return the lab table of a result and a picture of its pressure, for a notebook."""
    from tribo.cli.notebook import html

    return html(result)


def dataframe(result: "Result") -> "pd.DataFrame":
    """Return the saves of a result in the units of a laboratory."""
    from tribo.lab.tables import saves_table

    return saves_table(result).to_dataframe()
