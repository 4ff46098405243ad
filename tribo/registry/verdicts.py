"""Which plugins were shown to import, so that none is tried again until it changes."""

from __future__ import annotations

import json
import os
import sys
from contextlib import suppress
from hashlib import sha256
from importlib import machinery, metadata, util
from pathlib import Path
from threading import Lock

from tribo.registry.records import PluginRecord

_CODE = (*machinery.SOURCE_SUFFIXES, *machinery.EXTENSION_SUFFIXES)
_writing = Lock()


def shown_to_import(plugin: PluginRecord) -> bool:
    """Return whether this very code was imported before, in a process of its own."""
    with suppress(Exception):
        return bool(_read().get(_key(plugin)) == _stamp(plugin))
    return False


def remember(plugin: PluginRecord, imports: bool) -> None:
    """Keep that a plugin can be imported, or forget it; a cache that cannot be written is none."""
    with suppress(Exception), _writing:
        kept = _read()
        if not imports and _key(plugin) not in kept:
            return
        kept.pop(_key(plugin), None)
        if imports:
            kept[_key(plugin)] = _stamp(plugin)
        _file().parent.mkdir(parents=True, exist_ok=True)
        written = _file().with_suffix(f".{os.getpid()}")
        written.write_text(json.dumps(kept, indent=1))
        written.replace(_file())


def _file() -> Path:
    cache = Path(os.environ.get("XDG_CACHE_HOME", ""))
    return (cache if cache.is_absolute() else Path.home() / ".cache") / "tribo" / "plugins.json"


def _read() -> dict[str, str]:
    with suppress(OSError, ValueError, TypeError):
        return dict(json.loads(_file().read_bytes()))
    return {}


def _key(plugin: PluginRecord) -> str:
    return " ".join((plugin.distribution, plugin.entry_point, sys.executable))


def _stamp(plugin: PluginRecord) -> str:
    """Return a hash of the versions and of the name, time and size of each file of code."""
    stamp = [sys.version, metadata.version("tribo"), plugin.version]
    spec = util.find_spec(plugin.entry_point.split(":")[0].split(".")[0])
    assert spec is not None
    files = [Path(spec.origin)] if spec.origin else []
    for folder in spec.submodule_search_locations or ():
        files += [path for path in Path(folder).rglob("*") if path.name.endswith(_CODE)]
    for path in sorted(files):
        status = path.stat()
        stamp.append(f"{path} {status.st_mtime_ns} {status.st_size}")
    return sha256("\n".join(stamp).encode()).hexdigest()
