"""tribo: simulate wear, with every model a plugin.

Everything that a user types and a plugin needs is a name of this package; what
lies in its modules is not part of the contract. Names are imported when first
used, so that ``import tribo`` stays fast; ``__init__.pyi`` lists them.
"""

# `python -m tribo` begins here, and a folder that it was started in may have modules of the names
# of Python's, even a `__future__`: these import only what Python starts with.
from tribo.core import shorthand
from tribo.core.lazy import lazy
from tribo.packages import NAMES, how_to_install

shorthand.PLACES |= {
    "case": "tribo.config.load:validate_case",
    "changed": "tribo.config.load:changed_case",
    "check": "tribo.study.check:check_case",
    "html": "tribo.cli.notebook:html",
    "keys": "tribo.case:keys",
    "materials": "tribo.registry.registry:material_files",
    "overlay": "tribo.plotting.overlays:comparison_picture",
    "picture": "tribo.plotting.figures:result_picture",
    "plot": "tribo.plotting.figures:Plot",
    "registry": "tribo.registry.registry:default_registry",
    "report": "tribo.lab.report:lab_report",
    "saves": "tribo.lab.tables:saves_table",
    "show": "tribo.cli.lab_report:print_report",
    "show_comparison": "tribo.cli.compare:print_comparison",
    "simulation": "tribo.simulation.run:Simulation",
}
_get = lazy(__name__, __file__)
DEPRECATED: dict[str, tuple[str, str]] = {}
"""Old public names, each with the new name and the version in which the old one goes."""


def __getattr__(name: str) -> object:
    if name == "__version__":
        from importlib.metadata import version

        return version("tribo")
    if name in NAMES:
        package = NAMES[name]
        raise ImportError(
            f"{name!r} comes with {package}: {how_to_install(package)}, and "
            f"from {package.replace('-', '_')} import {name}"
        )
    if name in DEPRECATED:
        import warnings

        new, version = DEPRECATED[name]
        words = f"tribo.{name} is now tribo.{new}; tribo {version} has only that"
        warnings.warn(words, DeprecationWarning, stacklevel=2)
        return _get(new)
    return _get(name)


def __dir__() -> list[str]:
    return sorted(_get("__all__"))
