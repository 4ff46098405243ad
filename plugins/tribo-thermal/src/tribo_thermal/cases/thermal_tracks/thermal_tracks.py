"""The heat that earlier passes left on a track."""

from tribo_thermal.sources import kept_per_power

ONCE = {0.2: 0.23905747, 2: 0.13658599, 4.9: 0.093278624, 20: 0.048242004, 50: 0.030974112}
"""Rise of a source that moves on for ever, by its Peclet number."""
TRACKS = {
    "to and fro": ((4, 2), (20, 4.9), (100, 20), (2, 0.2), (2, 50), (10, 50), (100, 2)),
    "round": ((20, 4.9), (60, 20), (2, 0.2), (2, 50), (10, 50), (100, 2)),
}
"""Length of the track in radii, and Peclet number."""


def found() -> dict[str, float]:
    """Return the rise, relative to a source that does not return."""
    return {
        f"{way} over {length} radii, Pe {peclet:g}": 1
        + kept_per_power(1.0, 1.0, peclet, length, way == "to and fro") / ONCE[peclet]
        for way, tracks in TRACKS.items()
        for length, peclet in tracks
    }
