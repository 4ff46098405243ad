"""The heat that earlier passes left on a track."""

from tribo_thermal.sources import kept_per_power

ONCE = {
    "to and fro over 4 radii, Pe 2": (4, 2, 0.13658599),
    "to and fro over 20 radii, Pe 4.9": (20, 4.9, 0.093278624),
    "to and fro over 100 radii, Pe 20": (100, 20, 0.048242004),
    "round over 20 radii, Pe 4.9": (20, 4.9, 0.093278624),
    "round over 60 radii, Pe 20": (60, 20, 0.048242004),
    "to and fro over 2 radii, Pe 0.2": (2, 0.2, 0.23905747),
    "to and fro over 2 radii, Pe 50": (2, 50, 0.030974112),
    "to and fro over 10 radii, Pe 50": (10, 50, 0.030974112),
    "to and fro over 100 radii, Pe 2": (100, 2, 0.13658599),
    "round over 2 radii, Pe 0.2": (2, 0.2, 0.23905747),
    "round over 2 radii, Pe 50": (2, 50, 0.030974112),
    "round over 10 radii, Pe 50": (10, 50, 0.030974112),
    "round over 100 radii, Pe 2": (100, 2, 0.13658599),
}
"""Length of the track in radii, Peclet number, and rise of a source that moves on for ever."""


def found() -> dict[str, float]:
    """Return the rise, relative to a source that does not return."""
    return {
        name: 1 + kept_per_power(1.0, 1.0, peclet, length, name.startswith("to and fro")) / once
        for name, (length, peclet, once) in ONCE.items()
    }
