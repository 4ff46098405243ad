"""Read a case from a file, and validate it."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from tribo.case import Case
from tribo.config.overrides import apply_settings
from tribo.core.errors import CaseError
from tribo.core.explain import case_error
from tribo.core.hdf5 import MARK
from tribo.core.words import shown, similar_file
from tribo.registry.registry import Registry, default_registry

_WRITING = "quote texts and values with a unit, as '5 mm'; write 0.3, and each key once"


def load_case(
    path: str | Path | Mapping[str, Any],
    *,
    overrides: Sequence[str] | str = (),
    registry: Registry | None = None,
) -> Case:
    """Read a case from a TOML file, or from its tables.

    Parameters
    ----------
    path : str, Path or Mapping
        The file, or tables as such a file has them.
    overrides : sequence of str, or str
        Changes to it, as ``"load.normal=50"``; see `apply_settings`.
    registry : Registry, optional
        Where to look components up; the installed plugins if left out.

    Returns
    -------
    Case
        The valid case.

    Raises
    ------
    CaseError
        If the file cannot be read or the case is wrong; one line for each error.

    Examples
    --------
    >>> case = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides="load.normal=50 N")
    >>> case.load.normal, case.bodies["ball"].surface.radius
    (50.0, 0.005)
    """
    tables = case_tables(path)
    if overrides:
        tables = apply_settings(tables, overrides)
    return validate_case(tables, registry=registry)


def validate_case(data: Mapping[str, Any], *, registry: Registry | None = None) -> Case:
    """Turn tables, as a TOML file has them, into a case.

    Components are looked up in `registry`, the installed plugins if left out. `CaseError`, with a
    line for each error, if anything is wrong.
    """
    try:
        return Case.model_validate(data, context={"registry": registry or default_registry()})
    except ValidationError as error:
        raise case_error(error) from None
    except RecursionError:
        raise CaseError("tables or lists of the case are nested too deeply") from None


def changed_case(case: Case, settings: Mapping[str, Any]) -> Case:
    """Return a case with some values, by path, replaced."""
    return validate_case(apply_settings(case_tables(case), settings))


def case_tables(case: Case | Mapping[str, Any] | str | Path) -> Mapping[str, Any]:
    """Return the tables of a case, which is given as a Case, as tables or as a TOML file."""
    if isinstance(case, Case):
        # Classes of one's own are found again by their types.
        default_registry().know_all(case)
        tables = case.model_dump(mode="json")
        for body in tables["bodies"].values():
            # What a material of the case's own gives the body follows a change of that material.
            name = body["material"]["name"]
            if own := tables["materials"].get(name):
                differing = {k: v for k, v in body["material"].items() if v != own[k]}
                body["material"] = {**differing, "name": name}
        return tables
    return case if isinstance(case, Mapping) else read_toml(case)


def read_toml(
    path: str | Path, what: str = "a case", hint: str = "'tribo new' writes a case to start from"
) -> dict[str, Any]:
    """Read a TOML file; CaseError if there is none, or it is not TOML in UTF-8."""
    if not isinstance(path, str | Path):
        raise CaseError(f"{shown(path)} is not the name of a file of {what}; {hint}")
    path = Path(path)
    try:
        if path.is_dir():
            raise CaseError(f"{path} is a directory; give the file of {what} in it")
        content = path.read_bytes()
    except FileNotFoundError:
        remedy = similar_file(path, ".toml", hint)
        raise CaseError(f"{path}: there is no such file; {remedy}") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise CaseError(f"{path} cannot be read: {reason}") from None
    if content.startswith(MARK):
        raise CaseError(f"{path} is a result, not {what}; see it with: tribo show {path}")
    if not content.strip():
        raise CaseError(f"{path} is empty; {hint}")
    try:
        # Editors on Windows put a byte order mark at the start.
        data = tomllib.loads(content.decode("utf-8-sig"))
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise CaseError(f"{path}, line {line}: not UTF-8 text; save the file as UTF-8") from None
    except (ValueError, RecursionError) as error:
        raise CaseError(f"{path} is not TOML: {error}; {_WRITING}") from None
    return data
