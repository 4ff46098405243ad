"""Functions of higher layers that methods of lower ones are short for, such as ``case.run()``.

`tribo.methods` gives them, so that no module names what lies above it.
"""

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any, Protocol

    class Components(Protocol):
        """Where the class is found that a name in a case stands for."""

        def lookup(self, kind: str, name: str) -> type[Any]:
            """Return the class of a kind that a name stands for."""

        def choices(self, kind: str) -> str:
            """Return the names of a kind, as text."""


run: "Callable[..., Any]"
"""Run a case, and return the result."""
registry: "Callable[[], Components]"
"""Return the registry of the built-in and the installed plugins."""
materials: "Callable[[], list[Any]]"
"""Return the files of materials that packages offer."""
check: "Callable[..., Any]"
"""Predict what a case will do."""
case: "Callable[..., Any]"
"""Return the case that tables are of."""
changed: "Callable[..., Any]"
"""Return a case with some values replaced."""
show: "Callable[..., None]"
"""Print a result as the terminal does."""
report: "Callable[..., Any]"
"""Return what a laboratory would measure of a result."""
plot: "Callable[..., Any]"
"""Return the pictures of a result."""
picture: "Callable[..., Any]"
"""Draw one picture of a result."""
html: "Callable[..., str]"
"""Show a result in a notebook."""
dataframe: "Callable[..., Any]"
"""Return the saves of a result in the units of a laboratory."""
