"""A picture: panels in rows, drawn on paper of their size or on axes that are given."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribo.core.errors import CaseError
from tribo.plotting.style import SINGLE_COLUMN, WIDE, house_style, legend_below, new_figure

Panel = Callable[[Axes], Sequence[Artist]]
"""Draws on axes, and returns what the legend names."""


class NothingToDraw(CaseError):
    """The field to draw is uniform; the message is a sentence that replaces the picture."""


@dataclass(frozen=True)
class Picture:
    """Panels in rows, all of one size; `height` is the height of a row, in mm."""

    rows: Sequence[Sequence[Panel]]
    height: float
    share: Literal["x", "y", ""] = "x"
    """The axis that the panels of a column, or of a row, have in common, if any."""

    def figure(self) -> Figure:
        """Return the picture in the house style, tied to no display."""
        with house_style():
            width = WIDE if len(self.rows[0]) > 1 else SINGLE_COLUMN
            figure = new_figure(self.height * len(self.rows), width)
            self.fill(figure)
        return figure

    def fill(self, figure: Figure) -> Any:
        """Draw on an empty figure in the style that is set, and return its axes."""
        shape, share = (len(self.rows), len(self.rows[0])), self.share
        shared: Any = {"x": {"sharex": "col"}, "y": {"sharey": "row"}}.get(share, {})
        panels = figure.subplots(*shape, squeeze=False, **shared)
        if named := self._draw(panels.ravel()):
            legend_below(figure, named)
        inner = {"x": panels[:-1].flat, "y": panels[:, 1:].flat}.get(share, ())
        for axes in inner:
            axes.set(**{f"{share}label": ""})
        return panels.squeeze() if panels.size > 1 else panels.item()

    def draw(self, given: Any) -> Any:
        """Draw on axes that are given, one for each panel, and return them."""
        axes = np.ravel(np.asarray(given, dtype=object))
        rows, columns = len(self.rows), len(self.rows[0])
        if len(axes) != rows * columns:
            raise CaseError(
                f"the picture has {rows * columns} panels, {len(axes)} axes were given; make them "
                f"with figure, axes = plt.subplots({rows}, {columns})",
                "ax",
            )
        if named := self._draw(axes):
            axes[0].legend(handles=named)
        return given

    def _draw(self, axes: Iterable[Axes]) -> list[Artist]:
        """Draw the panels, and return what a legend names: each label once."""
        panels = [panel for row in self.rows for panel in row]
        named: dict[object, Artist] = {}
        for panel, on in zip(panels, axes, strict=True):
            named |= {artist.get_label(): artist for artist in panel(on)}
        return list(named.values())


def below_each_other(pictures: Sequence[Picture]) -> Picture:
    """Return pictures of one column as one, their rows as high as the highest."""
    rows = [row for picture in pictures for row in picture.rows]
    return Picture(rows, max(picture.height for picture in pictures), share="")
