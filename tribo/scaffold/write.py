"""Write the files of a new plugin."""

from __future__ import annotations

from datetime import date
from importlib.resources import files
from pathlib import Path
from string import Template

from tribo.core.errors import CaseError
from tribo.core.words import unknown
from tribo.core.writing import check_output, make_folder, write_file, writing
from tribo.registry.kinds import KINDS
from tribo.scaffold.names import plugin_names


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
    kinds = {known.replace("_", "-"): known for known in KINDS}
    if kind not in kinds:
        raise CaseError(unknown("kind", kind, kinds))
    words = {
        **plugin_names(name),
        "kind": kinds[kind],
        "words": kind.replace("-", " "),
        "article": "An" if kind[0] in "aeiou" else "A",
        "year": str(date.today().year),
    }
    words["example"] = _filled("$kind/example.toml", words).strip()
    layout = {
        "pyproject.toml": "common/pyproject.toml",
        "README.md": "common/README.md",
        "LICENSE": "common/LICENSE",
        ".gitignore": "common/gitignore",
        ".github/workflows/ci.yml": "common/ci.yml",
        "example.toml": "$kind/example.toml",
        "src/$package/__init__.py": "common/init.py",
        "src/$package/$module.py": "$kind/model.py",
        "src/$package/py.typed": "common/py.typed",
        "tests/conftest.py": "common/conftest.py",
        "tests/test_$module.py": "$kind/test_model.py",
    }
    texts = {
        folder / Template(path).substitute(words): _filled(template, words)
        for path, template in layout.items()
    }
    with writing(folder):
        if folder.exists():
            raise CaseError(f"{folder} exists; give another folder, or take it away first")
    check_output(folder)
    for file, text in texts.items():
        make_folder(file.parent)
        write_file(file, text)
    return sorted(texts)


def _filled(template: str, words: dict[str, str]) -> str:
    source = files("tribo.scaffold") / "files" / f"{Template(template).substitute(words)}.tmpl"
    return Template(source.read_text(encoding="utf-8")).substitute(words)
