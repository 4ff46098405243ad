"""Pictures of a result, for print and for notebooks."""

from tribo.plotting.figures import save_figures
from tribo.plotting.history import (
    contact_history,
    friction_history,
    real_contact,
    roughness_history,
    wear_history,
)
from tribo.plotting.pressure import pressure_map, pressure_sections
from tribo.plotting.profiles import body_profiles, worn_section
from tribo.plotting.relief import height_map, material_ratio_curves
from tribo.plotting.scar import scar_map

__all__ = [
    "body_profiles",
    "contact_history",
    "friction_history",
    "height_map",
    "material_ratio_curves",
    "pressure_map",
    "pressure_sections",
    "real_contact",
    "roughness_history",
    "save_figures",
    "scar_map",
    "wear_history",
    "worn_section",
]
