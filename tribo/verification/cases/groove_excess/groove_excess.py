"""What a run states of the average's groove, of the paper's hour by two strokes."""

from tribo.motion.averaging_error import groove_excess


def found() -> dict[str, float]:
    """Return the statement for grooves and half-widths of the average on 28 x 28 cells."""
    return {
        "stroke of 2 mm": groove_excess(0.00199643, 0.000510714, 8.03355e-06, 4.30167e-06),
        "stroke of 5 mm": groove_excess(0.00501429, 0.000510714, 3.44095e-06, 4.30167e-06),
    }
