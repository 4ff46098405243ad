"""A stroke of three half-widths of the first contact, and a plain loop over its cells."""

from paper_models import foundation, motion, small

from tribo import Grid

GRID = Grid((1.2e-3, 0.75e-3), (32, 20))
STROKE = 12 * GRID.spacing[0]


def resolved(positions="cells", duration=600, grid=GRID, **changes):
    """Return the model of a ball that slides along the stroke."""
    kinematics = motion(stroke=STROKE, duration=duration, positions=positions)
    return small(**{"grid": grid, "contact": foundation(), "kinematics": kinematics, **changes})
