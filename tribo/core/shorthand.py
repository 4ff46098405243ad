"""Functions of higher layers that methods of lower ones are short for, such as ``case.run()``.

`tribo.methods` gives them, so that no module imports what lies above it.
"""

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from tribo.lab.report import LabReport
    from tribo.registry.registry import Registry
    from tribo.result.read import Result

run: "Callable[..., Result]"
"""Run a case."""
registry: "Callable[[], Registry]"
"""Return the registry of the built-in and the installed plugins."""
report: "Callable[[Result], LabReport]"
"""Return what a laboratory would measure of a result."""
plot: "Callable[[Result, Path, str], list[Path]]"
"""Write the pictures of a result."""
html: "Callable[[Result], str]"
"""Show a result in a notebook."""
