"""Plugins from a file that a command line names."""

from __future__ import annotations

import inspect
import re
import sys
from collections.abc import Iterable
from hashlib import sha256
from importlib.machinery import ModuleSpec
from pathlib import Path
from types import ModuleType

from tribo.component import Component
from tribo.core.errors import CaseError
from tribo.registry.hookspecs import hookimpl
from tribo.registry.plugins import given
from tribo.registry.registry import default_registry, fault, process_kept


def add_files(paths: Iterable[Path | str]) -> None:
    """Run Python files, and let their components and hooks take part in this process.

    A file without the hook `tribo_components` offers each component that it defines. `CaseError` if
    one cannot be run or breaks the contract.
    """
    for path in map(Path, paths):
        module = ModuleType("plugin_" + re.sub(r"\W", "_", path.stem))
        module.__file__, module.__spec__ = str(path.resolve()), ModuleSpec(module.__name__, None)
        if not path.is_file():
            raise CaseError(f"{path}: there is no such file", "--plugin")
        try:
            code = path.read_bytes()
            if module.__name__ in sys.modules:
                raise ValueError("another file of this name takes part already")
            sys.modules[module.__name__] = module
            with process_kept():
                exec(compile(code, path, "exec"), vars(module))
            vars(module).setdefault("tribo_components", hookimpl(lambda of=module: _classes(of)))
            plugin, digest = given(module), sha256(code).hexdigest()[:12]
            plugin.distribution, plugin.version, plugin.origin = path.name, digest, "file"
            default_registry().add(plugin)
        except (Exception, SystemExit) as error:
            words = fault(error, module.__name__)
            where = "--plugin" if str(path) in words else f"--plugin {path}"
            raise CaseError(words, where) from error


def added_files() -> list[str]:
    """Return the paths of the files that take part in this process."""
    added = (each for each in default_registry().plugins if each.origin == "file")
    return [str(sys.modules[each.entry_point].__file__) for each in added]


def _classes(module: ModuleType) -> list[type[Component]]:
    classes = [each for each in vars(module).values() if inspect.isclass(each)]
    own = (each for each in classes if each.__module__ == module.__name__)
    return [each for each in own if issubclass(each, Component)]
