"""The conformance checks of tribo, on a small measured map."""

from pathlib import Path

from tribo.testing import parametrize_checks

from tribo_topography import MeasuredSurface

WAVES = Path(__file__).parent / "data" / "waves.asc"  # 30 × 30 pixels on 1.5 × 1.5 mm
KNOWN = {"path": WAVES, "expect_size": ["1.5 mm", "1.5 mm"]}

# Cells of the kit are smaller than these pixels, and are sampled at points.
test_sampled_at_points = parametrize_checks(
    MeasuredSurface,
    configs=[
        {**KNOWN, "detrend": "none", "expect_range": "2.55 um"},
        {**KNOWN, "detrend": "tilt", "expect_range": "2.57 um"},
        {**KNOWN, "detrend": "curvature", "expect_range": "2.56 um"},
        {
            **KNOWN,
            "detrend": "mean",
            "expect_range": "5.1 um",
            "height_scale": -2,
            "rotate": 90,
            "mirror": True,
            "centre": ["0.2 mm", "-0.1 mm"],
        },
    ],
)
