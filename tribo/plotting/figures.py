"""All pictures of a result: which there are, on axes, and in files."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from inspect import signature
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.backend_bases import FigureCanvasBase
from matplotlib.figure import Figure

from tribo.core.errors import CaseError, located
from tribo.core.units import Quantity
from tribo.core.words import unknown
from tribo.core.writing import make_folder, write_file
from tribo.lab.kept import kept_fields
from tribo.lab.scar import removed
from tribo.plotting.history import history, history_names
from tribo.plotting.picture import NothingToDraw, Picture
from tribo.plotting.pressure import pressure_map, pressure_sections
from tribo.plotting.profiles import body_profiles, field_map, scar_map, worn_section
from tribo.plotting.style import house_style
from tribo.registry.registry import from_plugins_of
from tribo.result.read import Result

# No dates, so that the same result gives the same file.
_METADATA: dict[str, dict[str, Any]] = {"pdf": {"CreationDate": None}, "svg": {"Date": None}}
TIME = Quantity("s", at_least=0)
_LOG = logging.getLogger("tribo.plotting")


def _worn(result: Result) -> list[str]:
    return [name for name in result.body_names if np.any(removed(result, name) > 0)]


def _fields(result: Result) -> list[str]:
    return [field.key for field in kept_fields(result) if field.varies]


@dataclass(frozen=True)
class PictureKind:
    """A kind of picture: its drawing function, its file, and its subjects, if not the result."""

    draw: Callable[..., Picture]
    file: str
    of: Callable[[Result], Sequence[str]] | None = None
    what: str = "body"

    def each(self, result: Result) -> list[tuple[str, ...]]:
        """Return the subjects of this picture in a result, () for the result."""
        return [()] if self.of is None else [(name,) for name in self.of(result)]


KINDS: Mapping[str, PictureKind] = {
    "pressure": PictureKind(pressure_map, "pressure_map"),
    "sections": PictureKind(pressure_sections, "pressure_sections"),
    "scar": PictureKind(scar_map, "{}_scar", _worn),
    "profiles": PictureKind(body_profiles, "{}_profiles", _worn),
    "worn_section": PictureKind(worn_section, "worn_section"),
    "history": PictureKind(history, "{}_history", history_names, "history"),
    "field": PictureKind(field_map, "{}_map", _fields, "field"),
}
"""The kinds of pictures by the names of the methods of `Plot`."""


class Plot:
    """The pictures of a result, on axes.

    ``plot("folder")`` writes all that say something to files. ``plot.scar("ball", time=200)``
    draws one in the style that is set in matplotlib, and returns its axes, or an array of them;
    a notebook shows it. ``ax`` are axes to draw on, one for each panel; ``time`` is a saved time,
    in s or as ``"200 s"``, and of profiles and sections a list of them, too. `dir` lists the
    pictures of this result.

    Examples
    --------
    >>> coarse = ["grid.cells=64", "contact.type=winkler", "stop.depth=1 um"]
    >>> result = tribo.load_case("tribo/templates/ball_on_disk.toml", overrides=coarse).run()
    >>> result.plot
    <Plot of the result: history, pressure, profiles, scar, sections, worn_section>
    """

    def __init__(self, result: Result) -> None:
        self._result = result

    def __call__(self, folder: str | Path, suffix: str = "png") -> list[Path]:
        """Write every picture that says something, as ``tribo plot`` does."""
        return save_figures(self._result, Path(folder), suffix)

    def __repr__(self) -> str:
        return f"<Plot of {self._result.name}: {', '.join(dir(self))}>"

    def __dir__(self) -> list[str]:
        return [name for name, kind in KINDS.items() if kind.each(self._result)]

    def __getattr__(self, name: str) -> Any:
        if name not in KINDS or not KINDS[name].each(self._result):
            raise AttributeError(unknown("picture", name, dir(self)))
        return partial(self._on_axes, name)

    def _on_axes(
        self, name: str, *of: str, time: Any = None, ax: Any = None, **options: Any
    ) -> Any:
        """Draw a picture on axes that are given, or on a figure of pyplot."""
        kind = KINDS[name]
        there = [each for (each,) in kind.each(self._result)] if kind.of else []
        if kind.of and not of and len(there) == 1:
            of = (there[0],)
        if kind.of and (len(of) != 1 or of[0] not in there):
            given = ", ".join(of) or "none"
            raise CaseError(unknown(kind.what, given, there), f"plot.{name}")
        takes = ["time", "ax", *({"axis"} & signature(kind.draw).parameters.keys())]
        if other := options.keys() - takes:
            words = f"there is no {other.pop()!r}; it takes {', '.join(takes)}"
            raise CaseError(words, f"plot.{name}")
        if time is not None:
            with located(f"plot.{name}"):
                options |= _saves(self._result, kind.draw, time)
        picture = kind.draw(self._result, *of, **options)
        if ax is not None:
            return picture.draw(ax)
        from matplotlib import pyplot

        figure = pyplot.figure(layout="constrained")
        figure.set_figheight(figure.get_figheight() * len(picture.rows))
        return picture.fill(figure)


def _saves(result: Result, draw: Callable[..., Picture], time: Any) -> dict[str, Any]:
    """Return the argument of a drawing function for a saved time, or for several if it takes so."""
    takes = signature(draw).parameters
    if "saves" in takes:
        times = np.ravel(np.asarray(time, dtype=object))
        return {"saves": [result.save_at(TIME.read(each)) for each in times]}
    if "save" not in takes:
        raise CaseError("a history has all times; leave time out")
    return {"save": result.save_at(TIME.read(time))}


def save_figures(
    result: Result,
    folder: Path,
    suffix: str = "png",
    tell: Callable[[str], object] = _LOG.info,
) -> list[Path]:
    """Write every picture that says something of a result, and return the files.

    They have the names of `KINDS`, and plugins add theirs. A picture of a worn surface is left out
    where nothing is worn, one over time where a single moment was saved, and one of a uniform
    field: `tell` takes the sentence that stands for it, the log of ``tribo.plotting`` by default.
    `suffix` is a format that matplotlib writes.

    Raises
    ------
    CaseError
        If the format is not known.
    OutputError
        If they cannot be written.
    """
    return write_figures(result_pictures(result, tell), folder, suffix)


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
    """Draw one of the pictures of `save_figures`; `CaseError` lists them if it has none such."""
    own, others = dict(_made(result)), dict(from_plugins_of(result, "tribo_figures"))
    if name in own:
        return own[name]().figure()
    if name not in others:
        raise CaseError(unknown("picture", name, [*own, *others]))
    with house_style():
        figure: Figure = others[name]()
    return figure


def result_pictures(
    result: Result, tell: Callable[[str], object] = _LOG.info
) -> dict[str, Callable[[], Figure]]:
    """Return how to draw each picture of a result, by file name; see `save_figures`."""
    pictures: dict[str, Callable[[], Figure]] = {}
    for name, make in _made(result):
        try:
            pictures[name] = make().figure
        except NothingToDraw as uniform:
            tell(f"No {name}: {uniform}")
    return pictures | dict(from_plugins_of(result, "tribo_figures"))


def _made(result: Result) -> Iterator[tuple[str, Callable[[], Picture]]]:
    """Yield how each picture is made, by file name."""
    for kind in KINDS.values():
        for of in kind.each(result):
            yield kind.file.format(*of), partial(kind.draw, result, *of)
