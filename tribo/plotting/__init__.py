"""Pictures of a result, for print and for notebooks."""

from tribo.plotting.figures import save_figures
from tribo.plotting.history import contact_history, wear_history
from tribo.plotting.pressure import pressure_map, pressure_sections
from tribo.plotting.profiles import body_profiles, groove, worn_section

__all__ = [
    "body_profiles",
    "contact_history",
    "groove",
    "pressure_map",
    "pressure_sections",
    "save_figures",
    "wear_history",
    "worn_section",
]
