"""Write the files of a new plugin."""

from __future__ import annotations

from datetime import date
from importlib.resources import files
from pathlib import Path
from string import Template

from tribo.core.errors import CaseError
from tribo.core.files import writing
from tribo.core.words import did_you_mean, suggestion
from tribo.registry.kinds import KINDS
from tribo.scaffold.names import PluginName


def write_plugin(name: str, kind: str, folder: Path) -> list[Path]:
    """Write a distribution with one working model, its tests and an example.

    It installs, and passes its tests, as it is.

    Parameters
    ----------
    name : str
        Name of the distribution, as ``acme-fretting``: it offers
        ``acme.fretting`` in the package ``acme_fretting``.
    kind : str
        What it offers: ``wear-law``, ``contact-solver``, ``kinematics``,
        ``surface``, ``effect`` or ``observer``.
    folder : Path
        The distribution's own folder, which must not exist yet; its parent
        must.

    Returns
    -------
    list of Path
        The files, sorted.

    Raises
    ------
    CaseError
        If the name is no good, the kind unknown, or the folder exists.
    OutputError
        If the files cannot be written.
    """
    plugin = PluginName(name)
    words = _words(plugin, _kind(kind))
    layout = {
        "pyproject.toml": "common/pyproject.toml",
        "README.md": "common/README.md",
        "LICENSE": "common/LICENSE",
        ".gitignore": "common/gitignore",
        ".github/workflows/ci.yml": "common/ci.yml",
        "example.toml": f"{words['kind']}/example.toml",
        f"src/{plugin.package}/__init__.py": "common/init.py",
        f"src/{plugin.package}/{plugin.module}.py": f"{words['kind']}/model.py",
        f"src/{plugin.package}/py.typed": "common/py.typed",
        f"tests/test_{plugin.module}.py": f"{words['kind']}/test_model.py",
    }
    texts = {path: _filled(template, words) for path, template in layout.items()}
    with writing(folder):
        _make(folder)
        for path, text in texts.items():
            file = folder / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
    return sorted(folder / path for path in texts)


def _kind(kind: str) -> str:
    name = kind.replace("-", "_")
    if name not in KINDS:
        known = [known.replace("_", "-") for known in KINDS]
        meant = suggestion(did_you_mean(kind, known))
        raise CaseError(f"unknown kind {kind!r}{meant} Known: {', '.join(known)}")
    return name


def _words(plugin: PluginName, kind: str) -> dict[str, str]:
    words = {
        "distribution": plugin.distribution,
        "package": plugin.package,
        "module": plugin.module,
        "component": plugin.component,
        "title": plugin.title,
        "kind": kind,
        "words": kind.replace("_", " "),
        "article": "An" if kind[0] in "aeiou" else "A",
        "year": str(date.today().year),
    }
    words["example"] = _filled(f"{kind}/example.toml", words).strip()
    return words


def _filled(template: str, words: dict[str, str]) -> str:
    source = files("tribo.scaffold") / "files" / f"{template}.tmpl"
    return Template(source.read_text(encoding="utf-8")).substitute(words)


def _make(folder: Path) -> None:
    if folder.exists():
        raise CaseError(f"{folder} exists; give another folder, or take it away first")
    if not folder.parent.is_dir():
        raise CaseError(f"there is no folder {folder.parent}; make it first")
    folder.mkdir()
