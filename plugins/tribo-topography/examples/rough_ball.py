"""A rough ball from a file, rubbed on a flat for a few metres."""

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from tribo import Simulation

SIZE, PIXELS = 0.6e-3, 96


def write_ball(path: Path, sq: float) -> float:
    """Write a ball of R = 5 mm with waves of 60 µm, as an instrument would; return its range."""
    from SurfaceTopography import Topography

    x = (np.arange(PIXELS) - 0.5 * (PIXELS - 1)) * (SIZE / PIXELS)
    form = -(x[:, None] ** 2 + x[None, :] ** 2) / 10e-3
    wave = 2 * np.pi / 60e-6
    heights = form + 2 * sq * np.cos(wave * x[:, None]) * np.cos(wave * x[None, :])
    Topography(heights, (SIZE, SIZE), unit="m").to_x3p(str(path))
    return float(np.ptp(heights))


def case(path: Path, span: float) -> dict[str, object]:
    """Return the case: the ball as it was measured, on a smooth flat that is swept."""
    steel = {"young": "207 GPa", "poisson": 0.3}
    wear = {"type": "archard", "k": "3.11e-16 1/Pa"}
    ball = {
        "type": "topography.file",
        "path": str(path),
        "detrend": "mean",
        "expect_size": [SIZE, SIZE],
        "expect_range": span,
    }
    return {
        "grid": {"size": ["0.5 mm", "0.5 mm"], "cells": [80, 80]},
        "load": {"normal": "40 N"},
        "bodies": {
            "ball": {"surface": ball, "material": steel, "wear": wear},
            "disk": {"surface": {"type": "flat"}, "material": steel, "wear": wear},
        },
        "contact": {"type": "dcfft"},
        "kinematics": {
            "type": "reciprocating",
            "stroke": "2 mm",
            "frequency": "25 Hz",
            "duration": "50 s",
            "positions": "average",
            "swept": "disk",
        },
    }


def main() -> None:
    """Print how the roughness runs in."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "ball.x3p"
        result = Simulation(case(path, write_ball(path, 0.1e-6))).run()
    for save in result.saves():
        print(
            f"{save['distance_m']:.1f} m: largest pressure {save['max_pressure_Pa'] / 1e9:.2f} GPa "
            f"on {1e6 * save['contact_area_m2']:.4f} mm²"
        )


if __name__ == "__main__":
    main()
