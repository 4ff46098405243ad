"""What pictures of sections share: panels, their limits and their curves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from tribo.core.arrays import Array
from tribo.plotting.style import (
    AXIS_LABELS,
    SINGLE_COLUMN,
    WIDE,
    Stroke,
    house_style,
    legend_below,
    legend_height,
    new_figure,
    ticks,
    times,
)
from tribo.plotting.units import Unit, height_unit, length_unit
from tribo.plotting.window import Limits, spread

SHAPE = 0.62
"""Height of the axes of a profile over their width, on paper."""
COLUMNS = 3
"""Most entries in a row of the legend of a picture of profiles."""


@dataclass(frozen=True)
class Section:
    """Curves along an axis, 0 or 1: positions and values in SI units."""

    axis: int
    window: Limits
    curves: Sequence[tuple[Array, Array]]

    @property
    def unit(self) -> Unit:
        """The unit of its positions."""
        return length_unit(max(map(abs, self.window)))

    def label(self, axes: Axes) -> None:
        """Set the limits and the label of the axis of positions."""
        axes.set_xlim(*(self.unit.factor * end for end in self.window))
        axes.set_xlabel(f"{AXIS_LABELS[self.axis]} ({self.unit.name})")
        axes.xaxis.set_major_locator(ticks(5))

    def draw(
        self, axes: Axes, unit: Unit, strokes: Sequence[Stroke], labels: Sequence[str]
    ) -> list[Line2D]:
        """Draw the curves with values in `unit`, and label the axis of positions."""
        self.label(axes)
        return [
            stroke.draw(axes, self.unit.of(position), unit.of(values), label)
            for (position, values), stroke, label in zip(self.curves, strokes, labels, strict=True)
        ]

    def visible(self) -> list[Array]:
        """Return the part of each curve that lies inside the limits, or all if none does."""
        low, high = self.window
        masks = [(position >= low) & (position <= high) for position, _ in self.curves]
        return [
            values[inside] if inside.any() else values
            for (_, values), inside in zip(self.curves, masks, strict=True)
        ]


def draw_profiles(
    sections: Sequence[Section], strokes: Sequence[Stroke], labels: Sequence[str], title: str
) -> Figure:
    """Draw profiles in one panel for each section, all with one scale of heights."""
    height = spread([line for section in sections for line in section.visible()])
    unit = height_unit(max(map(abs, height)))
    with house_style():
        figure = new_figure(
            (52.0 if len(sections) > 1 else 62.0) + legend_height(len(labels), COLUMNS),
            WIDE if len(sections) > 1 else SINGLE_COLUMN,
        )
        panels = figure.subplots(1, len(sections), sharey=True, squeeze=False)[0]
        for axes, section in zip(panels, sections, strict=True):
            curves = section.draw(axes, unit, strokes, labels)
            note_enlargement(axes, section.window, height, SHAPE)
        panels[0].set_ylim(*(unit.factor * end for end in height))
        panels[0].set_ylabel(f"Height ({unit.name})")
        panels[0].yaxis.set_major_locator(ticks(7))
        panels[0].set_title(title, loc="left")
        legend_below(figure, curves, columns=COLUMNS)
    return figure


def note_enlargement(axes: Axes, across: Limits, up: Limits, shape: float) -> None:
    """Give axes a height over width, and say how much larger they show heights than widths."""
    axes.set_box_aspect(shape)
    factor = shape * (across[1] - across[0]) / (up[1] - up[0])
    axes.set_title(f"height × {times(factor)}", loc="right", fontsize=7.0)
