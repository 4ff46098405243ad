"""The contents of the packages beside the kernel, to name what to install."""

COMMANDS = {
    "calibrate": ("tribo-inverse", "Fit a case to measured wear."),
    "report": ("tribo-report", "Write a result as one HTML file to hand on."),
    "scar": ("tribo-scar", "Measure a scar between two height maps."),
}
"""Package and summary of each command."""
_OF_INVERSE = """
Calibration Choice Plan calibrate choose_case plan_tests Gradient View Seeds gradient
value_and_gradient Deepest Depth EndTime Pressure Volume
"""
NAMES = {
    "write_report": "tribo-report",
    **dict.fromkeys(_OF_INVERSE.split(), "tribo-inverse"),
    **dict.fromkeys(("MeasuredScar", "measured_scar"), "tribo-scar"),
}
"""Package of each name that was one of `tribo`."""


def how_to_install(package: str) -> str:
    """Return the command that installs a package, in the folder of tribo's sources."""
    return f"pip install ./plugins/{package}"
