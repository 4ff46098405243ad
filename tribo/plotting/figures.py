"""Write all pictures of a result."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.backend_bases import FigureCanvasBase
from matplotlib.figure import Figure

from tribo.core.errors import CaseError
from tribo.core.words import did_you_mean, suggestion
from tribo.core.writing import make_folder, write_file
from tribo.lab.running_in import reliefs, rough_bodies
from tribo.plotting.history import (
    contact_history,
    fields_history,
    friction_history,
    real_contact,
    roughness_history,
    wear_history,
)
from tribo.plotting.kept import field_map, kept_fields, steady
from tribo.plotting.pressure import pressure_map, pressure_sections
from tribo.plotting.profiles import along_track, body_profiles, worn_section
from tribo.plotting.relief import height_map, material_ratio_curves
from tribo.plotting.scar import scar_map
from tribo.plotting.sections import removed
from tribo.plotting.style import house_style
from tribo.registry.registry import from_plugins_of
from tribo.result.read import Result

# No dates, so that the same result gives the same file.
_METADATA: dict[str, dict[str, Any]] = {"pdf": {"CreationDate": None}, "svg": {"Date": None}}


def save_figures(result: Result, folder: Path, suffix: str = "png") -> list[Path]:
    """Write every picture that makes sense for a result.

    Those of worn surfaces are left out where nothing is worn, those over time
    where there is one moment only.

    Parameters
    ----------
    result : Result
        What to draw.
    folder : Path
        Where to; it is made if need be.
    suffix : str, optional
        The format: png, pdf, svg or another that matplotlib writes.

    Returns
    -------
    list of Path
        The files: ``pressure_map`` of the last save, ``pressure_map_early`` of
        the first after the beginning, ``pressure_sections``, ``NAME_scar`` and
        ``NAME_profiles`` of each worn body NAME, or ``NAME_groove`` of a
        swept one and ``NAME_along_track`` where the cycle is resolved,
        ``NAME_height_map`` and ``NAME_material_ratio`` of each rough one,
        ``worn_section``, ``wear_history``, ``contact_history``,
        ``friction_history`` where the friction force changes and, of rough
        bodies, ``real_contact`` and ``roughness_history``; ``FIELD_map`` of each field that
        effects and laws keep or provide, and ``fields_history``; besides those of the plugins
        of the result's models.

    Raises
    ------
    CaseError
        If the format is not known.
    OutputError
        If they cannot be written.
    """
    return write_figures(result_pictures(result), folder, suffix)


def write_figures(
    pictures: Mapping[str, Callable[[], Figure]], folder: Path, suffix: str = "png"
) -> list[Path]:
    """Draw pictures and write them to files of their names; see `save_figures`."""
    suffix, paths = picture_format(suffix), []
    make_folder(folder)
    for name, draw in pictures.items():
        image = BytesIO()
        with house_style():
            draw().savefig(image, format=suffix, metadata=_METADATA.get(suffix))
        paths.append(folder / f"{name}.{suffix}")
        write_file(paths[-1], image.getbuffer())
    return paths


def picture_format(suffix: str) -> str:
    """Return the format of a suffix; `CaseError` if pictures are not written in it."""
    suffix, known = suffix.removeprefix("."), FigureCanvasBase.get_supported_filetypes()
    if suffix not in known:
        raise CaseError(f"pictures cannot be written as {suffix!r}; use one of {', '.join(known)}")
    return suffix


def result_picture(result: Result, name: str) -> Figure:
    """Draw one of the pictures of `result_pictures`; `CaseError` lists them if it has none such."""
    pictures = result_pictures(result)
    if name not in pictures:
        meant = suggestion(did_you_mean(name, pictures))
        raise CaseError(f"there is no picture {name!r}{meant} There are {', '.join(pictures)}")
    with house_style():
        return pictures[name]()


def result_pictures(result: Result) -> dict[str, Callable[[], Figure]]:
    """Return how to draw each picture of a result, by file name; see `save_figures`."""
    count = len(result.times)
    pictures: dict[str, Callable[[], Figure]] = {"pressure_map": partial(pressure_map, result)}
    if count > 2:
        pictures["pressure_map_early"] = partial(pressure_map, result, 1)
    pictures["pressure_sections"] = partial(pressure_sections, result)
    worn = [name for name in result.body_names if np.any(removed(result, name) > 0)]
    for name in worn:
        pictures[f"{name}_scar"] = partial(scar_map, result, name)
        if result.body(name).swept:
            pictures[f"{name}_groove"] = partial(body_profiles, result, name)
            if result.has("track_depth"):
                pictures[f"{name}_along_track"] = partial(along_track, result, name)
        else:
            pictures[f"{name}_profiles"] = partial(body_profiles, result, name)
    rough = rough_bodies(result)
    for name in rough if count > 1 else ():
        # A scar of a few cells has no relief.
        if np.isfinite(reliefs(result, result.body(name), -1).scar).any():
            pictures[f"{name}_height_map"] = partial(height_map, result, name)
            pictures[f"{name}_material_ratio"] = partial(material_ratio_curves, result, name)
    if worn:
        pictures["worn_section"] = partial(worn_section, result)
    history = result.table("history")
    if any(np.any(history[f"bodies.{name}.wear_volume_m3"] > 0) for name in result.body_names):
        pictures["wear_history"] = partial(wear_history, result)
    if len(history["time_s"]) > 1:
        pictures["contact_history"] = partial(contact_history, result)
        force = history["friction_force_N"]
        if np.isfinite(force).all() and not steady(force):
            pictures["friction_history"] = partial(friction_history, result)
        if rough:
            pictures["real_contact"] = partial(real_contact, result)
        if any(label.endswith(".Sq_m") for label in history):
            pictures["roughness_history"] = partial(roughness_history, result)
    kept = kept_fields(result)
    for field in kept:
        if field.varies:
            pictures[f"{field.key}_map"] = partial(field_map, result, field)
    if kept and count > 1:
        pictures["fields_history"] = partial(fields_history, result)
    return pictures | dict(from_plugins_of(result, "tribo_figures"))
